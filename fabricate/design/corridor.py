"""The longest corridor of the yellow region."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from fabricate.arrays import Indices, Mask
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh


def longest_corridor(duotone: Duotone) -> int:
    """Return the length of the longest corridor of yellow, in tiles: the diameter of the graph of its joined tiles.

    From any point one goes to the farthest, and from there to the farthest again. In a tree that is the longest path;
    where yellow has handles it is a shortest way between two points, at most the diameter and at least half of it.
    """
    return _length(duotone.quads, duotone.joined)


class CorridorCost:
    """Less by `step` for each tile of the longest corridor; see `fabricate.design.annealing.WholeCost`."""

    def __init__(self, quads: QuadMesh, *, step: float) -> None:
        self._quads = quads
        self.step = step

    def of(self, joined: Mask) -> float:
        """Return the cost of tiles in these states, (t,) bool; takes time in proportion to all tiles."""
        return -self.step * _length(self._quads, joined)


def _length(quads: QuadMesh, joined: Mask) -> int:
    ends = quads.tiles[joined][:, [0, 2]]
    graph = _graph(np.concatenate([ends, ends[:, ::-1]]), len(quads.points))
    away = dijkstra(graph, unweighted=True, indices=int(ends[0, 0]))
    farthest = int(np.where(np.isfinite(away), away, -1.0).argmax())
    away = dijkstra(graph, unweighted=True, indices=farthest)
    return int(away[np.isfinite(away)].max())


def _graph(pairs: Indices, nodes: int) -> csr_array:
    """Return the graph of directed pairs; parallel ones stay entries of their own."""
    by_tail = np.argsort(pairs[:, 0], kind="stable")
    begins = np.searchsorted(pairs[by_tail, 0], np.arange(nodes + 1))
    return csr_array((np.ones(len(pairs)), pairs[by_tail, 1], begins), shape=(nodes, nodes))
