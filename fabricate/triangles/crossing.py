"""Exact self-intersection of triangle meshes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from igl.copyleft.cgal import remesh_self_intersections

from fabricate.arrays import Floats, Indices

SLAB = 75_000
"""Larger meshes are cut into slabs of about so many triangles: the search among all of them at once takes longer."""


def crossing_triangles(points: Floats, triangles: Indices) -> Indices:
    """Return every pair of triangles that cross or overlap, once, (k, 2) int, the lower number first.

    Exact arithmetic on the given doubles (CGAL, through libigl): no tolerance. Triangles that merely
    share a corner or an edge by number do not count.
    """
    points = np.ascontiguousarray(points)
    found = [np.zeros((0, 2), dtype=np.int64)]
    for slab in _slabs(points, triangles):
        result = remesh_self_intersections(points, np.ascontiguousarray(triangles[slab]), detect_only=True)
        found.append(slab[np.asarray(result[2], dtype=np.int64).reshape(-1, 2)])
    pairs: Indices = np.unique(np.sort(np.concatenate(found), axis=1), axis=0)
    return pairs


def _slabs(points: Floats, triangles: Indices) -> Iterator[Indices]:
    """Yield the numbers of the triangles that reach into each of some slabs of space, rising.

    Two that cross have a place in common, so they are together in its slab, wherever the planes between slabs are.
    """
    count = -(-len(triangles) // SLAB)
    if count <= 1:
        if len(triangles):
            yield np.arange(len(triangles))
        return
    along = points[:, np.ptp(points, axis=0).argmax()][triangles]
    lowest, highest = along.min(axis=1), along.max(axis=1)
    planes = np.quantile(lowest[::100], np.arange(1, count) / count)
    first, last = np.searchsorted(planes, lowest), np.searchsorted(planes, highest)
    for slab in range(count):
        yield np.flatnonzero((first <= slab) & (slab <= last))
