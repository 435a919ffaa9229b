"""Spanning trees of the yellow graph: the tiles to join so that yellow becomes a disc.

Trees keep to locks by growing in the graph that these leave, see `YellowGraph`.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order, depth_first_order, minimum_spanning_tree

from fabricate.arrays import Floats, Indices, Mask
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.tile_locks import TileLocks
from fabricate.duotone.uniform_tree import uniform_tree
from fabricate.duotone.yellow_graph import YellowGraph
from fabricate.errors import PatternError

Tree: TypeAlias = Literal["random", "uniform", "breadth-first", "depth-first"]


def grown_duotone(
    quads: QuadMesh,
    *,
    tree: Tree,
    seed: int,
    root: int | None = None,
    reluctance: Indices | None = None,
    locks: TileLocks | None = None,
) -> Duotone:
    """Join a spanning tree of the named kind; `seed` draws what is random, or else the root if none is given.

    `reluctance` is for random trees, see `random_duotone`; others have a shape of their own.

    Raises
    ------
    PatternError
        If the root is no yellow point, or no tree keeps to the locks.
    """
    if tree == "random":
        return random_duotone(quads, seed=seed, reluctance=reluctance, locks=locks)
    if tree == "uniform":
        return uniform_duotone(quads, seed=seed, locks=locks)
    start = seeded_root(quads, seed=seed) if root is None else root
    grow = breadth_first_duotone if tree == "breadth-first" else depth_first_duotone
    return grow(quads, root=start, locks=locks)


def random_duotone(
    quads: QuadMesh, *, seed: int, reluctance: Indices | None = None, locks: TileLocks | None = None
) -> Duotone:
    """Join the minimum spanning tree of random weights drawn from `seed`.

    With `reluctance`, (t,) int, only trees of the least total reluctance are drawn, from all of these.
    """
    order = np.random.default_rng(seed).permutation(len(quads.tiles))
    if reluctance is not None:
        order = order[np.argsort(reluctance[order], kind="stable")]
    return _lightest(quads, order, locks)


def uniform_duotone(quads: QuadMesh, *, seed: int, locks: TileLocks | None = None) -> Duotone:
    """Join a tree drawn from `seed`, every tree that keeps to the locks being equally likely.

    Trees that differ in one of several parallel tiles are different trees.
    """
    graph = YellowGraph.of(quads, locks)
    return _joining(quads, graph.tiles[uniform_tree(graph.ends, nodes=graph.nodes, seed=seed)], locks)


def weighted_duotone(
    quads: QuadMesh, weights: Floats, *, seed: int | None = None, locks: TileLocks | None = None
) -> Duotone:
    """Join the minimum spanning tree of the given weights, one per tile.

    Ties are drawn from `seed`, and go to the lower tile without one.

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
    order = np.arange(len(weights)) if seed is None else np.random.default_rng(seed).permutation(len(weights))
    return _lightest(quads, order[np.argsort(weights[order], kind="stable")], locks)


def breadth_first_duotone(quads: QuadMesh, *, root: int, locks: TileLocks | None = None) -> Duotone:
    """Join the breadth-first tree from yellow point `root`: corridors that radiate from there."""
    graph = YellowGraph.of(quads, locks)
    parent = breadth_first_order(_symmetric(graph), graph.node_of[_checked_root(quads, root)])[1]
    return _joining(quads, _edges_to(graph, parent.astype(np.int64)), locks)


def depth_first_duotone(quads: QuadMesh, *, root: int, locks: TileLocks | None = None) -> Duotone:
    """Join the depth-first tree from yellow point `root`: one long winding corridor."""
    graph = YellowGraph.of(quads, locks)
    parent = depth_first_order(_symmetric(graph), graph.node_of[_checked_root(quads, root)])[1]
    return _joining(quads, _edges_to(graph, parent.astype(np.int64)), locks)


def seeded_root(quads: QuadMesh, *, seed: int) -> int:
    """Return a yellow point drawn from `seed`."""
    return int(np.random.default_rng(seed).choice(np.flatnonzero(quads.yellow)))


def _checked_root(quads: QuadMesh, root: int) -> int:
    if not 0 <= root < len(quads.points) or not quads.yellow[root]:
        raise PatternError(f"the root must be one of the {int(quads.yellow.sum())} yellow points, found {root}")
    return root


def _lightest(quads: QuadMesh, order: Indices, locks: TileLocks | None) -> Duotone:
    """Join the tree whose tiles come first in an order of all tiles."""
    graph = YellowGraph.of(quads, locks)
    low, high = graph.ends.T
    # weights are ranks counted from 1: an explicit zero would vanish from a sparse graph
    rank = np.zeros(len(order))
    rank[order] = np.arange(1, len(order) + 1)
    # row by row, so that parallel tiles stay entries of their own; built from pairs they would be summed
    by_row = np.argsort(low, kind="stable")
    begins = np.searchsorted(low[by_row], np.arange(graph.nodes + 1))
    weights = csr_array((rank[graph.tiles[by_row]], high[by_row], begins), shape=(graph.nodes, graph.nodes))
    tree = minimum_spanning_tree(weights)
    return _joining(quads, order[np.rint(tree.data).astype(np.int64) - 1], locks)


def _joining(quads: QuadMesh, tiles: Indices, locks: TileLocks | None) -> Duotone:
    """Join these tiles and those that are locked yellow."""
    joined: Mask = np.zeros(len(quads.tiles), dtype=bool) if locks is None else locks.yellow.copy()
    joined[tiles] = True
    return Duotone(quads, joined)


def _symmetric(graph: YellowGraph) -> csr_array:
    """Return the graph with entries both ways, of which parallel edges share one."""
    ends = np.concatenate([graph.ends, graph.ends[:, ::-1]])
    return csr_array((np.ones(len(ends)), tuple(ends.T)), shape=(graph.nodes, graph.nodes))


def _edges_to(graph: YellowGraph, parent: Indices) -> Indices:
    """Return the tile between each node and its parent, the lowest of parallel ones; the root's is negative."""
    child = np.flatnonzero(parent >= 0)
    wanted = np.sort(np.stack([child, parent[child]], axis=1), axis=1) @ (graph.nodes, 1)
    known = graph.ends @ (graph.nodes, 1)
    order = np.argsort(known, kind="stable")
    tiles: Indices = graph.tiles[order[np.searchsorted(known, wanted, sorter=order)]]
    return tiles
