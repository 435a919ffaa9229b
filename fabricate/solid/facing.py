"""The facing walls of the two parts: how far apart they are between two layers."""

from __future__ import annotations

import igl
import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.solid.layers import Layer, wall

DOWN_WALL = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Where edges and diagonals are measured, from the upper end to the lower one."""


def wall_gaps(outer: Layer, inner: Layer, curve: Indices) -> Floats:
    """Return the smallest distance between the facing walls beside each curve point, (c,) float, mm.

    Each wall is measured along the edges down it and along the diagonals of its cells, against the other wall's
    triangles; a diagonal counts for the points at both ends of its cell.
    """
    count = len(curve)
    cells = wall(np.arange(count), count, 0)
    walls = [
        np.concatenate([upper[curve], lower[curve]])
        for upper, lower in ((outer.yellow, inner.yellow), (outer.blue, inner.blue))
    ]
    gaps = np.full(count, np.inf)
    for own, other in (walls, walls[::-1]):
        upper, lower = own[:count], own[count:]
        down = [upper + share * (lower - upper) for share in DOWN_WALL]
        across = [upper + share * (np.roll(lower, -1, axis=0) - upper) for share in DOWN_WALL[1:-1]]
        tree = igl.AABB()
        tree.init(other, cells)
        squared = tree.squared_distance(other, cells, np.concatenate(down + across))[0]
        distance = np.sqrt(np.asarray(squared).reshape(-1, count))
        gaps = np.minimum.reduce([gaps, *distance, *np.roll(distance[len(down) :], 1, axis=1)])
    return gaps
