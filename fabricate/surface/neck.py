"""Necks: how narrow each colour becomes where it is joined across a tile."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats
from fabricate.surface.cut import CutSurface


def tile_necks(surface: CutSurface) -> tuple[Floats, Floats]:
    """Return the smallest distance between the two arcs of each tile, (t,) float, mm, and where, (t, 3).

    It belongs to the colour that is joined across the tile, before clearance is taken off. On a flat square of side
    s it is (sqrt 2 - 2 (1 - r)) s for yellow, (sqrt 2 - 2 r) s for blue (Garigipati 2013, 3.3).
    """
    first, second = surface.points[surface.arcs[0::2]], surface.points[surface.arcs[1::2]]
    best = np.full(len(first), np.inf)
    place = np.zeros((len(first), 3))
    for k in range(first.shape[1]):
        distance = np.linalg.norm(first[:, k, None] - second, axis=2)
        nearest = distance.argmin(axis=1)
        shorter = distance.min(axis=1)
        better = shorter < best
        best[better] = shorter[better]
        middle = 0.5 * (first[:, k] + second[np.arange(len(second)), nearest])
        place[better] = middle[better]
    return best, place
