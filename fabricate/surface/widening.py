"""Widening: new tiles grow until necks are wide enough to print, at the cost of the larger ones around them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fabricate.arrays import Mask
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.errors import SolidError
from fabricate.prepare.triangle_mesh import TriangleMesh
from fabricate.surface.fitting import fitted
from fabricate.surface.neck import NeckGauge
from fabricate.surface.sizing import typical_side
from fabricate.surface.squaring import squared

TYPICAL_SHARE = 0.8
"""No neck is widened beyond this share of the typical one: where that is too narrow, tiles are too small altogether."""

MOST_NARROW = 0.2
"""With a larger share of narrow tiles there is nowhere that room could come from."""

FITS, ROUNDS, SLIDES = 4, 8, 4
"""Fits to the surface, rounds of measuring and pushing before each, and slides in a round."""

PUSH, MOST_PUSH, EASE = 1.1, 1.6, 0.95
"""By how much a narrow tile's wanted side grows in a round, and at most; and how a wide one's returns to normal."""

EMPHASIS = 6.0
"""Power of the push by which a pushed tile counts against its neighbours."""


def widened(quads: QuadMesh, onto: TriangleMesh, *, rings: Sequence[float], neck: float) -> QuadMesh:
    """Return tiles that slid over a surface until each can be joined, one way or the other, `neck` mm wide or more.

    Where a body is too thin for that, the tiling with the fewest narrow tiles is returned, of those whose smooth
    surface does not cross itself; the very same quads if none is narrow, or far too many are.

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
    """
    gauge = NeckGauge.of(quads, rings=rings)

    def narrow(tiles: QuadMesh) -> Mask:
        too_narrow: Mask = gauge.necks(tiles.points).max(axis=1) < goal
        return too_narrow

    goal = min(neck, TYPICAL_SHARE * float(np.median(gauge.necks(quads.points).max(axis=1))))
    best, fewest = quads, int(np.count_nonzero(narrow(quads)))
    side, push = typical_side(quads), np.ones(len(quads.tiles))
    for _ in range(FITS):
        if not 0 < fewest <= MOST_NARROW * len(quads.tiles):
            break
        for _ in range(ROUNDS):
            wanting = narrow(quads)
            if not wanting.any():
                break
            push = np.where(wanting, np.minimum(PUSH * push, MOST_PUSH), 1.0 + EASE * (push - 1.0))
            for _ in range(SLIDES):
                quads = squared(quads, sides=side * push, weights=push**EMPHASIS)
        try:
            quads = fitted(quads, onto.points, onto.triangles)
        except SolidError:
            break
        count = int(np.count_nonzero(narrow(quads)))
        if count >= fewest:
            break
        best, fewest = quads, count
    return best
