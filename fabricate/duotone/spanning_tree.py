"""Spanning trees of the yellow graph: the tiles to join so that yellow becomes a disc.

The yellow graph has a node for every yellow point and an edge for every tile, its yellow diagonal.
Coarse meshes have tiles that share both yellow corners: parallel edges, of which a tree uses one.
"""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order, depth_first_order, minimum_spanning_tree

from fabricate.arrays import Floats, Indices, Mask
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.errors import PatternError


class _YellowGraph(NamedTuple):
    """The yellow graph without parallel edges; edge data are the tile numbers plus one, never zero."""

    tiles: Indices
    low: Indices
    high: Indices
    nodes: int


Tree: TypeAlias = Literal["random", "breadth-first", "depth-first"]


def grown_duotone(
    quads: QuadMesh, *, tree: Tree, seed: int, root: int | None = None, reluctance: Indices | None = None
) -> Duotone:
    """Join a spanning tree of the named kind; `seed` draws the random weights, or else the root if none is given.

    `reluctance` is for random trees, see `random_duotone`; others have a shape of their own.
    """
    if tree == "random":
        return random_duotone(quads, seed=seed, reluctance=reluctance)
    start = seeded_root(quads, seed=seed) if root is None else root
    grow = breadth_first_duotone if tree == "breadth-first" else depth_first_duotone
    return grow(quads, root=start)


def random_duotone(quads: QuadMesh, *, seed: int, reluctance: Indices | None = None) -> Duotone:
    """Join the minimum spanning tree of random weights drawn from `seed`.

    With `reluctance`, (t,) int, only trees of the least total reluctance are drawn, from all of these.
    """
    order = np.random.default_rng(seed).permutation(len(quads.tiles))
    if reluctance is not None:
        order = order[np.argsort(reluctance[order], kind="stable")]
    return _lightest(quads, order)


def weighted_duotone(quads: QuadMesh, weights: Floats) -> Duotone:
    """Join the minimum spanning tree of the given weights, one per tile; ties go to the lower tile.

    Raises
    ------
    PatternError
        If there is not one finite weight per tile.
    """
    if weights.shape != (len(quads.tiles),) or not np.isfinite(weights).all():
        raise PatternError(
            f"expected one finite weight for each of the {len(quads.tiles)} tiles, found an array of shape "
            f"{weights.shape} with {int((~np.isfinite(weights)).sum())} weights that are not finite"
        )
    return _lightest(quads, np.argsort(weights, kind="stable"))


def breadth_first_duotone(quads: QuadMesh, *, root: int) -> Duotone:
    """Join the breadth-first tree from yellow point `root`: corridors that radiate from there."""
    graph = _yellow_graph(quads, np.arange(len(quads.tiles)))
    parent = breadth_first_order(_symmetric(graph), _checked_root(quads, root))[1]
    return _from_parents(quads, graph, parent.astype(np.int64))


def depth_first_duotone(quads: QuadMesh, *, root: int) -> Duotone:
    """Join the depth-first tree from yellow point `root`: one long winding corridor."""
    graph = _yellow_graph(quads, np.arange(len(quads.tiles)))
    parent = depth_first_order(_symmetric(graph), _checked_root(quads, root))[1]
    return _from_parents(quads, graph, parent.astype(np.int64))


def seeded_root(quads: QuadMesh, *, seed: int) -> int:
    """Return a yellow point drawn from `seed`."""
    return int(np.random.default_rng(seed).choice(np.flatnonzero(quads.yellow)))


def _checked_root(quads: QuadMesh, root: int) -> int:
    if not 0 <= root < len(quads.points) or not quads.yellow[root]:
        raise PatternError(f"the root must be one of the {int(quads.yellow.sum())} yellow points, found {root}")
    return root


def _yellow_graph(quads: QuadMesh, order: Indices) -> _YellowGraph:
    """Keep of each bundle of parallel tiles the one that comes first in `order`."""
    ends = quads.tiles[order][:, [0, 2]]
    low, high = ends.min(axis=1), ends.max(axis=1)
    first = np.sort(np.unique(low * len(quads.points) + high, return_index=True)[1])
    return _YellowGraph(order[first], low[first], high[first], len(quads.points))


def _lightest(quads: QuadMesh, order: Indices) -> Duotone:
    low, high = np.sort(quads.tiles[:, [0, 2]], axis=1).T
    nodes, tiles = len(quads.points), len(order)
    # weights are ranks counted from 1: an explicit zero would vanish from a sparse graph
    rank = np.zeros(tiles)
    rank[order] = np.arange(1, tiles + 1)
    # row by row, so that parallel tiles stay entries of their own; built from pairs they would be summed
    by_row = np.argsort(low, kind="stable")
    begins = np.searchsorted(low[by_row], np.arange(nodes + 1))
    tree = minimum_spanning_tree(csr_array((rank[by_row], high[by_row], begins), shape=(nodes, nodes)))
    joined: Mask = np.zeros(tiles, dtype=bool)
    joined[order[np.rint(tree.data).astype(np.int64) - 1]] = True
    return Duotone(quads, joined)


def _symmetric(graph: _YellowGraph) -> csr_array:
    rows = np.concatenate([graph.low, graph.high])
    columns = np.concatenate([graph.high, graph.low])
    return csr_array((np.ones(len(rows)), (rows, columns)), shape=(graph.nodes, graph.nodes))


def _from_parents(quads: QuadMesh, graph: _YellowGraph, parent: Indices) -> Duotone:
    child = np.flatnonzero(parent >= 0)
    above = parent[child]
    keys = np.minimum(child, above) * graph.nodes + np.maximum(child, above)
    known = graph.low * graph.nodes + graph.high
    order = np.argsort(known)
    joined: Mask = np.zeros(len(quads.tiles), dtype=bool)
    joined[graph.tiles[order[np.searchsorted(known, keys, sorter=order)]]] = True
    return Duotone(quads, joined)
