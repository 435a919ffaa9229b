"""Exact self-intersection of triangle meshes."""

from __future__ import annotations

import numpy as np
from igl.copyleft.cgal import remesh_self_intersections

from fabricate.arrays import Floats, Indices


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
