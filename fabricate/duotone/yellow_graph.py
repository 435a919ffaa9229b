"""The yellow graph: a node for every yellow point and an edge for every tile, its yellow diagonal.

Coarse meshes have tiles that share both yellow corners: parallel edges, each an edge of its own.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from fabricate.arrays import Indices, frozen
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.tile_locks import TileLocks
from fabricate.errors import PatternError


@dataclass(frozen=True, eq=False)
class YellowGraph:
    """What is left to choose from: locked tiles are contracted where they are yellow, and gone where they are blue.

    Spanning trees of this graph, each together with the tiles that are locked yellow, are the spanning trees of the
    whole one that keep to the locks.

    Attributes
    ----------
    nodes : int
        Yellow points; those that locked tiles join count as one.
    node_of : (n,) int
        Node of each yellow point; -1 for blue ones.
    tiles : (m,) int
        Tile of each edge, in rising order; none joins a node to itself.
    ends : (m, 2) int
        Nodes that each edge joins, the lower number first.
    """

    nodes: int
    node_of: Indices
    tiles: Indices
    ends: Indices

    def __post_init__(self) -> None:
        object.__setattr__(self, "node_of", frozen(self.node_of, np.int64, (None,)))
        object.__setattr__(self, "tiles", frozen(self.tiles, np.int64, (None,)))
        object.__setattr__(self, "ends", frozen(self.ends, np.int64, (len(self.tiles), 2)))

    @classmethod
    def of(cls, quads: QuadMesh, locks: TileLocks | None = None) -> YellowGraph:
        """Return the graph of all tiles, or of those that locks leave.

        Raises
        ------
        PatternError
            If no spanning tree keeps to the locks.
        """
        point = np.where(quads.yellow, np.cumsum(quads.yellow) - 1, -1)
        ends = np.sort(point[quads.tiles[:, [0, 2]]], axis=1)
        count = int(quads.yellow.sum())
        if locks is None:
            return cls(count, point, np.arange(len(ends)), ends)
        node = components(ends[locks.yellow], count)
        nodes = int(node.max()) + 1
        if count - nodes < locks.yellow.sum():
            raise PatternError("tiles that are locked yellow close a ring, which no tree has")
        ends = np.sort(node[ends], axis=1)
        tiles = np.flatnonzero(locks.free & (ends[:, 0] < ends[:, 1]))
        if components(ends[tiles], nodes).any():
            raise PatternError("tiles that are locked blue cut yellow apart, which no tree is")
        return cls(nodes, np.where(quads.yellow, node[point], -1), tiles, ends[tiles])


def components(ends: Indices, nodes: int) -> Indices:
    """Return the number of the connected component of each of the nodes that edges, (m, 2) int, join."""
    graph = csr_array((np.ones(len(ends), dtype=np.int32), tuple(ends.T)), shape=(nodes, nodes))
    return connected_components(graph, directed=False)[1].astype(np.int64)
