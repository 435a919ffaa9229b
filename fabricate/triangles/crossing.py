"""Exact self-intersection of triangle meshes."""

from __future__ import annotations

import numpy as np
from igl.copyleft.cgal import remesh_self_intersections

from fabricate.arrays import Floats, Indices

BLOCK = 40_000
"""Larger meshes are cut into blocks of about so many triangles: the search among all of them at once takes longer."""


def crossing_triangles(points: Floats, triangles: Indices) -> Indices:
    """Return every pair of triangles that cross or overlap, once, (k, 2) int, the lower number first.

    Exact arithmetic on the given doubles (CGAL, through libigl): no tolerance. Triangles that merely
    share a corner or an edge by number do not count.
    """
    points = np.ascontiguousarray(points)
    found = [np.zeros((0, 2), dtype=np.int64)]
    for block in _blocks(points, triangles):
        result = remesh_self_intersections(points, np.ascontiguousarray(triangles[block]), detect_only=True)
        found.append(block[np.asarray(result[2], dtype=np.int64).reshape(-1, 2)])
    pairs: Indices = np.unique(np.sort(np.concatenate(found), axis=1), axis=0)
    return pairs


def _blocks(points: Floats, triangles: Indices) -> list[Indices]:
    """Return the numbers of the triangles that reach into each of some blocks of space, rising.

    Two that cross have a place in common, so they are together in its block, wherever the planes between blocks are.
    """
    blocks = [np.arange(len(triangles))] if len(triangles) else []
    along = max(1, round(np.sqrt(len(triangles) / BLOCK)))
    for axis in np.argsort(-np.ptp(points, axis=0))[:2] if along > 1 else ():
        places = np.ascontiguousarray(points[:, axis])
        blocks = [slab for block in blocks for slab in _slabs(places[triangles[block]], block, count=along)]
    return blocks


def _slabs(corners: Floats, numbers: Indices, *, count: int) -> list[Indices]:
    """Return the numbers of the triangles that reach into each of `count` slabs, from their corners along an axis."""
    lowest, highest = corners.min(axis=1), corners.max(axis=1)
    planes = np.quantile(lowest[:: max(1, len(lowest) // 1000)], np.arange(1, count) / count)
    first, last = np.searchsorted(planes, lowest), np.searchsorted(planes, highest)
    return [numbers[(first <= slab) & (slab <= last)] for slab in range(count)]
