"""The longest corridor of the yellow region."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order

from fabricate.arrays import Mask
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh


def longest_corridor(duotone: Duotone) -> int:
    """Return the length of the longest corridor of yellow, in tiles: the diameter of the graph of its joined tiles.

    From any point one goes to the farthest, and from there to the farthest again. In a tree that is the longest path;
    where yellow has handles it is the shortest way between two points, at most the diameter and at least half of it.
    """
    return Corridors(duotone.quads).longest(duotone.joined)


class Corridors:
    """The yellow graph of all tiles, sorted once, so that those that are joined can be picked out again and again."""

    def __init__(self, quads: QuadMesh) -> None:
        tails, heads = quads.tiles[:, [0, 2]].T.ravel(), quads.tiles[:, [2, 0]].T.ravel()
        by_tail = np.argsort(tails, kind="stable")
        self._heads, self._tiles = heads[by_tail], by_tail % len(quads.tiles)
        self._begins = np.searchsorted(tails[by_tail], np.arange(len(quads.points) + 1))

    def longest(self, joined: Mask) -> int:
        """Return `longest_corridor` of tiles in these states, (t,) bool."""
        used = joined[self._tiles]
        begins = np.append(0, np.cumsum(used))[self._begins]
        nodes = len(begins) - 1
        graph = csr_array((np.ones(begins[-1]), self._heads[used], begins), shape=(nodes, nodes))
        far = breadth_first_order(graph, int(self._heads[used.argmax()]), return_predecessors=False)[-1]
        order, before = breadth_first_order(graph, far)
        return _steps(before.tolist(), int(order[-1]))


class CorridorCost:
    """Less by `step` for each tile of the longest corridor; see `fabricate.design.annealing.WholeCost`."""

    def __init__(self, quads: QuadMesh, *, step: float) -> None:
        self._corridors = Corridors(quads)
        self.step = step

    def of(self, joined: Mask) -> float:
        """Return the cost of tiles in these states, (t,) bool; takes time in proportion to all tiles."""
        return -self.step * self._corridors.longest(joined)


def _steps(before: list[int], node: int) -> int:
    """Return how many steps lead from a node back to where the search began."""
    steps = 0
    while before[node] >= 0:
        node, steps = before[node], steps + 1
    return steps
