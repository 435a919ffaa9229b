"""Duotones whose necks are as wide as the tiles allow: a tile that is narrow joined one way is joined the other way."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fabricate.arrays import Indices
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.spanning_tree import Tree, grown_duotone
from fabricate.duotone.tile_locks import TileLocks
from fabricate.surface.neck import NeckGauge

STEPS = 4
"""Into how many steps the way up to a wide neck is divided; necks within one step count as alike."""


def wide_duotone(
    quads: QuadMesh,
    *,
    tree: Tree,
    seed: int,
    rings: Sequence[float],
    neck: float,
    depth: float = 0.0,
    root: int | None = None,
    locks: TileLocks | None = None,
) -> Duotone:
    """Join a spanning tree; a random one avoids tiles whose necks would be narrower for it than `neck` mm.

    That is on the surface or `depth` mm under it. A tile's neck runs along the diagonal that is joined, and is narrow
    where the other diagonal is short. Of random trees one is drawn in which as few tiles as possible are joined the
    narrower way. The other kinds of trees have a shape of their own, or none that is likelier than others, which they
    keep.

    Raises
    ------
    PatternError
        If the positions of the arcs are out of range or do not increase, or no tree keeps to the locks.
    """
    reluctance = neck_reluctance(quads, rings=rings, neck=neck, depth=depth) if tree == "random" else None
    return grown_duotone(quads, tree=tree, seed=seed, root=root, reluctance=reluctance, locks=locks)


def neck_reluctance(quads: QuadMesh, *, rings: Sequence[float], neck: float, depth: float = 0.0) -> Indices:
    """Return by how many steps each tile's neck is narrower yellow-joined than blue-joined, (t,) int."""
    necks = NeckGauge.of(quads, rings=rings, depth=depth).necks(quads.points)
    reached = np.floor(STEPS * np.minimum(necks / neck, 1.0)).astype(np.int64)
    steps: Indices = reached[:, 1] - reached[:, 0]
    return steps
