"""Uniform trees: every one there is, equally often."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from itertools import combinations

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from polyhedra import beads, named, quad_meshes, seeds
from scipy.stats import chisquare

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
from fabricate.duotone.spanning_tree import uniform_duotone
from fabricate.duotone.tile_locks import TileLocks
from fabricate.duotone.uniform_tree import uniform_tree
from fabricate.duotone.yellow_graph import YellowGraph

CUBE_GRAPH = subdivided(named()["tetrahedron"], levels=1)
PARALLEL = two_coloured(beads(3))
BUNDLE = np.array([[0, 1], [0, 1], [0, 1], [1, 2], [0, 2]])
"""A triangle with one side three times."""
DRAWS_PER_TREE = 12


def count_trees(ends: np.ndarray, nodes: int) -> int:
    """Number of spanning trees: any cofactor of the Laplacian (Kirchhoff); parallel edges count each."""
    laplacian = np.zeros((nodes, nodes))
    for a, b in ends:
        laplacian[[a, b], [a, b]] += 1
        laplacian[[a, b], [b, a]] -= 1
    return round(np.linalg.det(laplacian[1:, 1:]))


def trees_of(quads: QuadMesh, locks: TileLocks | None = None) -> int:
    graph = YellowGraph.of(quads, locks)
    return count_trees(graph.ends, graph.nodes)


def fairness(draw: Callable[[int], np.ndarray], trees: int, *, draws: int = DRAWS_PER_TREE) -> float:
    """Chance that fair draws are at least as uneven as these, by the chi-square test."""
    seen = Counter(draw(seed).tobytes() for seed in range(draws * trees))
    assert len(seen) <= trees
    return float(chisquare([*seen.values(), *[0] * (trees - len(seen))]).pvalue)


def tree_of_random_weights(seed: int) -> np.ndarray:
    order = np.random.default_rng(seed).permutation(len(BUNDLE))
    tree, pieces = [], nx.utils.UnionFind(range(3))
    for edge in order:
        a, b = BUNDLE[edge].tolist()
        if pieces[a] != pieces[b]:
            pieces.union(a, b)
            tree.append(edge)
    return np.sort(tree)


@pytest.mark.parametrize("quads", [CUBE_GRAPH, PARALLEL], ids=["cube graph", "parallel edges"])
def test_every_tree_is_equally_likely(quads: QuadMesh) -> None:
    trees = trees_of(quads)
    assert trees >= 12
    assert fairness(lambda seed: uniform_duotone(quads, seed=seed).joined, trees) > 0.001


def test_of_parallel_edges_each_makes_a_tree_of_its_own() -> None:
    trees = count_trees(BUNDLE, 3)
    assert trees == 3 * 2 + 1
    fair = fairness(lambda seed: np.sort(uniform_tree(BUNDLE, nodes=3, seed=seed)), trees, draws=400)
    assert fair > 0.001 > 1e-6 > fairness(tree_of_random_weights, trees, draws=400)


def test_the_count_is_that_of_the_cube() -> None:
    assert trees_of(CUBE_GRAPH) == 384


def test_the_count_is_that_of_all_sets_of_edges_that_are_trees() -> None:
    graph = YellowGraph.of(PARALLEL)
    sets = [nx.MultiGraph(chosen) for chosen in combinations(graph.ends.tolist(), graph.nodes - 1)]
    assert count_trees(graph.ends, graph.nodes) == sum(len(tree) == graph.nodes and nx.is_tree(tree) for tree in sets)


def test_trees_that_keep_to_locks_are_equally_likely() -> None:
    yellow, blue = np.zeros((2, len(CUBE_GRAPH.tiles)), dtype=bool)
    yellow[0], blue[5] = True, True
    locks = TileLocks(yellow, blue)
    trees = trees_of(CUBE_GRAPH, locks)
    assert 30 < trees < 384
    drawn = [uniform_duotone(CUBE_GRAPH, seed=seed, locks=locks).joined for seed in range(20)]
    assert all(joined[0] and not joined[5] for joined in drawn)
    assert fairness(lambda seed: uniform_duotone(CUBE_GRAPH, seed=seed, locks=locks).joined, trees) > 0.001


@given(quads=quad_meshes(), seed=seeds)
def test_the_edges_are_a_spanning_tree_of_the_graph(quads: QuadMesh, seed: int) -> None:
    graph = YellowGraph.of(quads)
    chosen = uniform_tree(graph.ends, nodes=graph.nodes, seed=seed)
    tree = nx.Graph(graph.ends[chosen].tolist())
    assert len(chosen) == graph.nodes - 1 == len(tree) - 1
    assert nx.is_tree(tree)


def test_one_node_needs_no_edge() -> None:
    assert len(uniform_tree(np.zeros((0, 2), dtype=int), nodes=1, seed=0)) == 0
