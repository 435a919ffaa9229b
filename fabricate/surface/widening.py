"""Widening: new tiles grow until necks are wide enough to print, at the cost of the larger ones around them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.errors import SolidError
from fabricate.prepare.triangle_mesh import TriangleMesh
from fabricate.surface.deviation import spread
from fabricate.surface.fitting import fitted
from fabricate.surface.limit import limit_vertices
from fabricate.surface.neck import NeckGauge
from fabricate.surface.sizing import typical_side
from fabricate.surface.squaring import squared
from fabricate.triangles.adjacency import grown, neighbour_means
from fabricate.triangles.search_tree import Nearest, SearchTree

TYPICAL_SHARE = 0.85
"""No neck is widened beyond this share of the typical one: where that is too narrow, tiles are too small altogether."""

MOST_NARROW = 0.2
"""With a larger share of narrow tiles there is nowhere that room could come from."""

FITS, ROUNDS, SLIDES = 6, 8, 4
"""Fits to the surface, rounds of measuring and pushing before each, and slides in a round."""

LOST, PLACES = 0.25, 20_000
"""Share of a tile's side by which a place of the surface may come to lie further from the tiles before it counts as
lost; and at how many places that is looked at."""

AROUND_LOST = 2
"""How many rings of points around a lost place stay where they were."""

PUSH, MOST_PUSH, EASE = 1.1, 1.6, 0.95
"""By how much a narrow tile's wanted side grows in a round, and at most; and how a wide one's returns to normal."""

EMPHASIS = 6.0
"""Power of the push by which a pushed tile counts against its neighbours."""


def widened(
    quads: QuadMesh, onto: TriangleMesh, *, rings: Sequence[float], neck: float, depth: float = 0.0
) -> QuadMesh:
    """Return tiles that slid over a surface until each can be joined, one way or the other, `neck` mm wide or more.

    Where a body is too thin for that, the tiling with the fewest narrow tiles is returned, of those whose smooth
    surface does not cross itself and has lost nothing of the body; the very same quads if none is narrow, or far too
    many are. Tiles pulled off a thin part, which is how it is lost, stay where they were from then on.

    Parameters
    ----------
    quads : QuadMesh
        Fitted to the surface.
    onto : TriangleMesh
        The surface, mm.
    rings : sequence of float
        Where curves cross tile sides.
    neck : float
        Width that necks have to have before clearance is taken off, mm.
    depth : float
        How far under the surface they have to have it, too, mm, as far as that can be had.
    """
    gauge = NeckGauge.of(quads, rings=rings, depth=depth)

    def narrow(tiles: QuadMesh) -> Mask:
        too_narrow: Mask = gauge.necks(tiles.points).max(axis=1) < goal
        return too_narrow

    goal = min(neck, TYPICAL_SHARE * float(np.median(gauge.necks(quads.points).max(axis=1))))
    best, fewest = quads, int(np.count_nonzero(narrow(quads)))
    side, push = typical_side(quads), np.ones(len(quads.tiles))
    kept = _Kept.of(quads, onto, slack=LOST * side)
    held: Mask = np.zeros(len(quads.points), dtype=bool)
    for _ in range(FITS):
        if not 0 < fewest <= MOST_NARROW * len(quads.tiles):
            break
        for _ in range(ROUNDS):
            wanting = narrow(quads)
            if not wanting.any():
                break
            push = np.where(wanting, np.minimum(PUSH * push, MOST_PUSH), 1.0 + EASE * (push - 1.0))
            for _ in range(SLIDES):
                slid = squared(quads, sides=side * push, weights=push**EMPHASIS)
                quads = replace(quads, points=np.where(held[:, None], quads.points, slid.points))
        try:
            quads = fitted(quads, onto.points, onto.triangles)
        except SolidError:
            break
        lost = kept.lost(quads)
        if lost.any():
            held, quads, push = held | lost, best, np.ones(len(quads.tiles))
            continue
        count = int(np.count_nonzero(narrow(quads)))
        if count >= fewest:
            break
        best, fewest = quads, count
    return best


@dataclass(frozen=True, eq=False)
class _Kept:
    """Places of a body, (k, 3) mm, and how far from the smooth surface of its tiles they may be, (k,) mm."""

    places: Floats
    reach: Floats

    @classmethod
    def of(cls, quads: QuadMesh, onto: TriangleMesh, *, slack: float) -> _Kept:
        """Allow for `slack` mm more than there is now."""
        places = spread(onto.points, onto.triangles, count=PLACES)
        return cls(places, _nearest(quads, places).distance + slack)

    def lost(self, quads: QuadMesh) -> Mask:
        """Return the points of the tiles, (n,) bool, around places that are further away than they may be."""
        nearest = _nearest(quads, self.places)
        near: Mask = np.zeros(len(quads.points), dtype=bool)
        near[_fans(quads)[nearest.triangle[nearest.distance > self.reach]]] = True
        return grown(near, neighbour_means(_fans(quads), count=len(near)), AROUND_LOST)


def _nearest(quads: QuadMesh, places: Floats) -> Nearest:
    return SearchTree.of(limit_vertices(quads), _fans(quads)).nearest(places)


def _fans(quads: QuadMesh) -> Indices:
    """Return the triangle at every corner of every tile, (4 t, 3) int."""
    return quads.tiles[:, [[0, 1, 2], [1, 2, 3], [2, 3, 0], [3, 0, 1]]].reshape(-1, 3)
