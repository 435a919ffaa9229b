"""Distances of points from a surface where they are near it: those of far ones cost most, and nobody asks for them."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.triangles.search_tree import SearchTree

CELL = 1.6
"""Side of the cells of which one point is measured first, in reaches."""

ROUNDING = 1e-6
"""A point is farther than the reach only if it is so by this share: more than double precision can be off."""


def near_distances(tree: SearchTree, points: Floats, *, reach: float, always: Mask) -> Floats:
    """Return how far points, (n, 3), are from a surface, or `reach` for those that are farther than that, (n,) mm.

    Those of `always`, (n,) bool, and some others are measured however far they are.

    Of the points in each cell of a grid one is measured. Another one is as much nearer as it is away from that one at
    most: if that leaves more than the reach, it need not be measured.
    """
    distances = np.full(len(points), reach)
    order, begins = _cells(points, CELL * reach)
    sizes = np.diff(begins, append=len(order))
    chosen = order[begins + sizes // 2]
    distances[chosen] = tree.nearest(points[chosen]).distance
    of_cell = np.repeat(chosen, sizes)
    ways = np.linalg.norm(points[order] - points[of_cell], axis=1)
    left = np.array(always)
    left[order] |= distances[of_cell] - ways <= (1.0 + ROUNDING) * reach
    left[chosen] = False
    distances[left] = tree.nearest(points[left]).distance
    return distances


def _cells(points: Floats, side: float) -> tuple[Indices, Indices]:
    """Return the numbers of points, cell by cell, (n,) int, and where each cell begins among them."""
    places = np.floor((points - points.min(axis=0)) / side).astype(np.int64)
    _, rows, layers = places.max(axis=0) + 1
    cells = (places[:, 0] * rows + places[:, 1]) * layers + places[:, 2]
    order = np.argsort(cells, kind="stable")
    return order, np.flatnonzero(np.diff(cells[order], prepend=-1))
