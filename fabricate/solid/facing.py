"""The facing walls of the two parts: how far apart they are between two layers."""

from __future__ import annotations

import igl
import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.solid.layers import Layer, wall


def wall_gaps(outer: Layer, inner: Layer, curve: Indices) -> Floats:
    """Return the smallest distance between the facing walls beside each curve point, (c,) float, mm.

    Each wall is measured at its corners, midway down, and in the middle of each cell, against the other wall's
    triangles; a cell counts for the points at both of its ends.
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
        across = 0.5 * (upper + np.roll(lower, -1, axis=0))
        queries = np.concatenate([upper, lower, 0.5 * (upper + lower), across])
        tree = igl.AABB()
        tree.init(other, cells)
        squared = np.asarray(tree.squared_distance(other, cells, queries)[0]).reshape(4, count)
        distance = np.sqrt(squared)
        ahead = np.roll(distance[3], 1)
        gaps = np.minimum.reduce([gaps, *distance, ahead])
    return gaps
