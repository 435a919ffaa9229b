"""Homology: which closed ways on a surface cut it in two, told by a word on each edge."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order

from fabricate.arrays import Indices, Mask, Words
from fabricate.prepare.triangle_mesh import Edges, TriangleMesh, adjacency, edges

WORDS = 4
"""Random words of 64 bits for each generator: up to some 200 loops can be told to be independent."""


def edge_words(mesh: TriangleMesh) -> Words:
    """Return a word for every edge, (e, 4) uint64, in the order of `triangle_mesh.edges`.

    The exclusive or of the words along a closed way is zero if the way, with others that are zero, bounds a part of the
    surface, and random otherwise; two ways have equal words if together they bound a part. Those of a connected
    surface without handles are all zero.

    That is a random cocycle over Z2: zero on a spanning tree, random on the 2 g edges that are in neither this tree nor
    one of the dual graph, and elsewhere such that the three words of each triangle cancel.

    References
    ----------
    D. Eppstein, "Dynamic generators of topologically embedded graphs", SODA 2003, for the two trees.
    """
    joined = edges(mesh)
    in_tree = _spanning_tree(mesh, joined)
    levels, across = _dual_tree(mesh, joined, in_tree)
    generating = ~in_tree
    generating[across[np.concatenate(levels)]] = False
    words = np.zeros((len(joined.ends), WORDS), dtype=np.uint64)
    rng = np.random.default_rng(0)
    words[generating] = rng.integers(1, 1 << 63, (int(generating.sum()), WORDS), dtype=np.uint64)
    sides = joined.of_triangle
    for level in levels[::-1]:
        words[across[level]] = np.bitwise_xor.reduce(words[sides[level]], axis=1)
    return words


def _spanning_tree(mesh: TriangleMesh, joined: Edges) -> Mask:
    """Return which edges are in a tree that spans the points, (e,) bool."""
    _, before = breadth_first_order(adjacency(mesh, joined), 0, directed=False)
    first, second = joined.ends.T
    in_tree: Mask = (before[first] == second) | (before[second] == first)
    return in_tree


def _dual_tree(mesh: TriangleMesh, joined: Edges, in_tree: Mask) -> tuple[list[Indices], Indices]:
    """Return the triangles of a tree over the other edges, level by level below its root, and each one's edge up."""
    free = np.flatnonzero(~in_tree)
    rows, columns = np.concatenate([joined.triangles[free], joined.triangles[free, ::-1]]).T
    count = len(mesh.triangles)
    numbers = coo_array((np.tile(free + 1, 2), (rows, columns)), shape=(count, count)).tocsr()
    order, before = (found.astype(np.int64) for found in breadth_first_order(numbers, 0, directed=False))
    across = np.zeros(count, dtype=np.int64)
    across[order[1:]] = np.asarray(numbers[order[1:], before[order[1:]]]).ravel() - 1
    levels = [order[:1]]
    position = np.zeros(count, dtype=np.int64)
    position[order] = np.arange(count)
    above = position[before[order[1:]]]
    begin = 1
    while begin < count:
        end = begin + int(np.searchsorted(above[begin - 1 :], begin))
        levels.append(order[begin:end])
        begin = end
    return levels[1:], across
