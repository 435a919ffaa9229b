"""Exact self-intersection of triangle meshes."""

from __future__ import annotations

import numpy as np
from igl.copyleft.cgal import remesh_self_intersections

from fabricate.arrays import Floats, Indices, Mask


def crossing_triangles(points: Floats, triangles: Indices) -> Indices:
    """Return every pair of triangles that cross or overlap, (k, 2) int.

    Exact arithmetic on the given doubles (CGAL, through libigl): no tolerance. Triangles that merely
    share a corner or an edge by number do not count.
    """
    if not len(triangles):
        return np.zeros((0, 2), dtype=np.int64)
    result = remesh_self_intersections(np.ascontiguousarray(points), np.ascontiguousarray(triangles), detect_only=True)
    pairs: Indices = np.asarray(result[2], dtype=np.int64).reshape(-1, 2)
    return pairs


def triangles_near(points: Floats, triangles: Indices, moved: Mask, *, reach: float = 0.0) -> Indices:
    """Return the numbers of all triangles within `reach`, mm, of one with a moved corner, (k,) int; a safe superset.

    Triangles that near have centroids within two thirds of the sum of their longest edges and the reach, so both
    lie in the same or in neighbouring cells of a grid that is 4/3 of the longest edge and the reach wide.
    """
    corners = points[triangles]
    longest = max(float(np.linalg.norm(corners[:, k] - corners[:, k - 1], axis=1).max()) for k in range(3))
    cells = np.floor((corners.mean(axis=1) - points.min(axis=0)) / (4.0 / 3.0 * longest + reach)).astype(np.int64) + 1
    shape = cells.max(axis=0) + 2
    occupied = np.zeros(shape, dtype=bool)
    occupied[tuple(cells[moved[triangles].any(axis=1)].T)] = True
    for axis in range(3):
        occupied |= np.roll(occupied, 1, axis=axis) | np.roll(occupied, -1, axis=axis)
    return np.flatnonzero(occupied[tuple(cells.T)])
