"""The duotone that a wish asks for, step by step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.design.alignment import alignment
from fabricate.design.curve_wish import CurveWish
from fabricate.design.field import field_directions, field_weights
from fabricate.design.locks import tile_locks
from fabricate.design.wide_tree import wide_duotone
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.spanning_tree import weighted_duotone
from fabricate.duotone.tile_locks import TileLocks
from fabricate.errors import PatternError
from fabricate.surface.limit import limit_vertices


@dataclass(frozen=True, eq=False)
class Design:
    """A duotone and what was found in choosing it.

    Attributes
    ----------
    duotone : Duotone
        The curve, as the tiles that are joined.
    locks : TileLocks or None
        Tiles that were held in one colour; None if none was to be.
    alignment : float or None
        Mean |cos| between the joined diagonals and the field; None unless that is one of directions.
    """

    duotone: Duotone
    locks: TileLocks | None = None
    alignment: float | None = None


def grown(quads: QuadMesh, wish: CurveWish) -> Duotone:
    """Return the duotone of the tree alone, without locks: quickly made, with necks as wide as in the whole design.

    Raises
    ------
    PatternError
        If the positions of the arcs are out of range or do not increase.
    """
    return _tree(quads, wish, None)


def designed(quads: QuadMesh, wish: CurveWish) -> Design:
    """Return the duotone that a wish asks for.

    Raises
    ------
    PatternError
        If the positions of the arcs are out of range or do not increase, or locks contradict each other.
    """
    locks = tile_locks(quads, wish.locks, seed=wish.seed) if wish.locks else None
    duotone = _tree(quads, wish, locks)
    directions = None if wish.field is None else field_directions(quads, wish.field)
    return Design(duotone, locks, None if directions is None else alignment(duotone, directions))


def _tree(quads: QuadMesh, wish: CurveWish, locks: TileLocks | None) -> Duotone:
    if wish.tree == "field":
        if wish.field is None:
            raise PatternError('tree = "field" needs a field to follow, found none')
        weights = field_weights(quads, wish.field, seed=wish.seed)
        return weighted_duotone(quads, weights, seed=wish.seed, locks=locks)
    root = None if wish.root is None else _nearest_yellow(quads, wish.root)
    return wide_duotone(quads, tree=wish.tree, seed=wish.seed, root=root, rings=wish.rings, neck=wish.neck, locks=locks)


def _nearest_yellow(quads: QuadMesh, place: tuple[float, float, float]) -> int:
    """Return the yellow point whose place on the smooth surface is nearest to another, mm."""
    away = np.linalg.norm(limit_vertices(quads) - np.asarray(place), axis=1)
    return int(np.where(quads.yellow, away, np.inf).argmin())
