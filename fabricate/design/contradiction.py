"""Locked tiles that rule out every single curve: a ring in yellow, or one in blue, which cuts yellow apart."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order

from fabricate.arrays import Indices, Mask
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.yellow_graph import components


def yellow_ring(quads: QuadMesh, yellow: Mask) -> Indices:
    """Return tiles, all of them in `yellow`, (t,) bool, whose yellow diagonals close a ring; none if there is no ring.

    The first tile is the one that closes it.
    """
    tiles, points = np.flatnonzero(yellow), len(quads.points)
    ends = quads.tiles[tiles][:, [0, 2]]
    without, closed = 0, len(tiles) + 1  # how many of the first tiles have no ring, and one
    while closed - without > 1:
        middle = (without + closed) // 2
        merged = points - 1 - int(components(ends[:middle], points).max())
        without, closed = (middle, closed) if merged == middle else (without, middle)
    if closed > len(tiles):
        return np.zeros(0, dtype=np.int64)
    return tiles[[without, *_path(ends[:without], *ends[without])]]


def _path(ends: Indices, begin: int, end: int) -> list[int]:
    """Return the edges on the way between two points in a forest with edges `ends`, (m, 2) int."""
    points = max(int(ends.max(initial=0)), begin, end) + 1
    forest = csr_array((np.ones(len(ends)), tuple(ends.T)), shape=(points, points))
    parent = breadth_first_order(forest, begin, directed=False)[1]
    edge = {frozenset(pair): number for number, pair in enumerate(ends.tolist())}
    path = []
    while end != begin:
        path.append(edge[frozenset((end, int(parent[end])))])
        end = int(parent[end])
    return path


def blue_cut(quads: QuadMesh, blue: Mask) -> Indices:
    """Return tiles, all of them in `blue`, (t,) bool, that cut off a part of yellow if they are joined in blue.

    They are those round the smallest such part; none if all other tiles together connect yellow.
    """
    ends = quads.tiles[:, [0, 2]]
    part = components(ends[~blue], len(quads.points))
    sizes = np.bincount(part[quads.yellow])
    if np.count_nonzero(sizes) == 1:
        return np.zeros(0, dtype=np.int64)
    smallest = np.where(sizes > 0, sizes, len(part)).argmin()
    inside = part[ends] == smallest
    return np.flatnonzero(inside[:, 0] != inside[:, 1])
