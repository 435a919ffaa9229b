from __future__ import annotations

from collections.abc import Callable
from typing import get_args

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import beads, named, quad_meshes, seeds, surfaces
from truchet import diagonals, joined_graph, locks_of_some_tree

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
from fabricate.duotone.spanning_tree import (
    Tree,
    breadth_first_duotone,
    depth_first_duotone,
    grown_duotone,
    random_duotone,
    seeded_root,
    uniform_duotone,
    weighted_duotone,
)
from fabricate.duotone.tile_locks import TileLocks
from fabricate.errors import PatternError
from fabricate.mesh.polygon_mesh import PolygonMesh

MESHES = quad_meshes()
NAMED = {name: subdivided(mesh, levels=1) for name, mesh in named().items()}
PARALLEL = {count: two_coloured(beads(count)) for count in (2, 3, 4, 9)}
MAKERS: dict[str, Callable[[QuadMesh, int], Duotone]] = {
    "random": lambda quads, seed: random_duotone(quads, seed=seed),
    "uniform": lambda quads, seed: uniform_duotone(quads, seed=seed),
    "weighted": lambda quads, seed: weighted_duotone(quads, some_weights(quads, seed)),
    "breadth first": lambda quads, seed: breadth_first_duotone(quads, root=seeded_root(quads, seed=seed)),
    "depth first": lambda quads, seed: depth_first_duotone(quads, root=seeded_root(quads, seed=seed)),
}
makers = pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)


def some_weights(quads: QuadMesh, seed: int) -> np.ndarray:
    """Return weights with ties, zeros and negative numbers among them."""
    return np.random.default_rng(seed).integers(-3, 4, size=len(quads.tiles)).astype(np.float64)


def parallels(quads: QuadMesh) -> int:
    """Return the number of tiles that share both yellow corners with an earlier one."""
    graph = diagonals(quads, first=0)
    return int(graph.number_of_edges() - nx.Graph(graph).number_of_edges())


def assert_spanning_tree(duotone: Duotone) -> None:
    tree = joined_graph(duotone, first=0)
    assert set(tree) == set(np.flatnonzero(duotone.quads.yellow).tolist())
    assert nx.is_tree(tree)
    assert duotone.joined.sum() == duotone.quads.yellow.sum() - 1


@makers
@given(quads=MESHES, seed=seeds)
def test_joined_tiles_are_a_tree_that_spans_all_yellow_points(
    make: Callable[[QuadMesh, int], Duotone], quads: QuadMesh, seed: int
) -> None:
    assert_spanning_tree(make(quads, seed))


@makers
@pytest.mark.parametrize("count", PARALLEL)
def test_parallel_diagonals_are_there_and_do_no_harm(make: Callable[[QuadMesh, int], Duotone], count: int) -> None:
    assert parallels(PARALLEL[count]) == (3 if count == 2 else count)
    for seed in range(20):
        assert_spanning_tree(make(PARALLEL[count], seed))


@given(mesh=surfaces(), levels=st.integers(1, 2))
def test_subdivision_leaves_no_parallel_diagonals(mesh: PolygonMesh, levels: int) -> None:
    # every diagonal joins a vertex to a face point, and no face has a vertex twice
    assert parallels(subdivided(mesh, levels=levels)) == 0


@makers
@given(quads=MESHES, seed=seeds)
def test_the_same_seed_gives_the_same_tree(
    make: Callable[[QuadMesh, int], Duotone], quads: QuadMesh, seed: int
) -> None:
    assert (make(quads, seed).joined == make(quads, seed).joined).all()


@pytest.mark.parametrize("name", NAMED)
def test_different_seeds_give_different_trees(name: str) -> None:
    found = {random_duotone(NAMED[name], seed=seed).joined.tobytes() for seed in range(10)}
    assert len(found) >= 9


@pytest.mark.parametrize("name", ["tetrahedron", "octahedron"])
def test_every_tile_can_be_joined_and_left(name: str) -> None:
    states = np.array([random_duotone(NAMED[name], seed=seed).joined for seed in range(100)])
    assert states.any(axis=0).all()
    assert not states.all(axis=0).any()


@given(quads=MESHES, seed=seeds)
def test_weight_is_the_least_that_networkx_finds(quads: QuadMesh, seed: int) -> None:
    weights = some_weights(quads, seed)
    graph = diagonals(quads, first=0)
    for *_, tile, data in graph.edges(keys=True, data=True):
        data["weight"] = weights[tile]
    least = nx.minimum_spanning_tree(graph).size("weight")
    assert weights[weighted_duotone(quads, weights).joined].sum() == pytest.approx(least)


@pytest.mark.parametrize("count", PARALLEL)
def test_of_parallel_tiles_the_lightest_counts(count: int) -> None:
    quads = PARALLEL[count]
    for seed in range(20):
        weights = np.random.default_rng(seed).normal(size=len(quads.tiles))
        chosen = weighted_duotone(quads, weights).joined
        for low, high in nx.Graph(diagonals(quads, first=0)).edges:
            bundle = np.flatnonzero((np.sort(quads.tiles[:, [0, 2]], axis=1) == sorted((low, high))).all(axis=1))
            assert chosen[bundle].sum() <= 1
            assert not chosen[bundle].any() or chosen[bundle[np.argmin(weights[bundle])]]


@given(quads=MESHES, seed=seeds)
def test_reluctance_comes_first_and_chance_second(quads: QuadMesh, seed: int) -> None:
    reluctance = np.random.default_rng(seed).integers(-2, 3, size=len(quads.tiles))
    least = reluctance[weighted_duotone(quads, reluctance.astype(float)).joined].sum()
    drawn = [random_duotone(quads, seed=number, reluctance=reluctance).joined for number in range(5)]
    assert all(reluctance[joined].sum() == least for joined in drawn)
    alike = random_duotone(quads, seed=seed, reluctance=np.zeros(len(quads.tiles), dtype=int)).joined
    assert (alike == random_duotone(quads, seed=seed).joined).all()


@given(quads=MESHES, seed=seeds, scale=st.floats(1e-6, 1e6))
def test_only_the_order_of_weights_counts(quads: QuadMesh, seed: int, scale: float) -> None:
    weights = some_weights(quads, seed)
    first = weighted_duotone(quads, weights).joined
    assert (first == weighted_duotone(quads, scale * weights - 7).joined).all()


@given(quads=MESHES)
def test_ties_go_to_the_lower_tile(quads: QuadMesh) -> None:
    equal = weighted_duotone(quads, np.zeros(len(quads.tiles))).joined
    rising = weighted_duotone(quads, np.arange(len(quads.tiles), dtype=float)).joined
    assert (equal == rising).all()


@given(quads=MESHES, seed=seeds)
def test_ties_may_be_drawn(quads: QuadMesh, seed: int) -> None:
    weights = some_weights(quads, seed)
    least = weights[weighted_duotone(quads, weights).joined].sum()
    drawn = [weighted_duotone(quads, weights, seed=number).joined for number in range(5)]
    assert all(weights[joined].sum() == least for joined in drawn)
    alike = weighted_duotone(quads, np.zeros(len(quads.tiles)), seed=seed).joined
    assert (alike == random_duotone(quads, seed=seed).joined).all()


@pytest.mark.parametrize("tree", get_args(Tree))
@given(quads=MESHES, seed=seeds)
def test_trees_keep_to_locks(tree: Tree, quads: QuadMesh, seed: int) -> None:
    locks = locks_of_some_tree(quads, seed)
    grown = grown_duotone(quads, tree=tree, seed=seed, locks=locks)
    assert grown.joined[locks.yellow].all()
    assert not grown.joined[locks.blue].any()
    assert_spanning_tree(grown)


@given(quads=MESHES, seed=seeds)
def test_weight_is_the_least_that_locks_allow(quads: QuadMesh, seed: int) -> None:
    locks, weights = locks_of_some_tree(quads, seed), some_weights(quads, seed)
    pressed = np.where(locks.yellow, -100.0, np.where(locks.blue, 100.0, weights))
    grown = weighted_duotone(quads, weights, locks=locks)
    assert_spanning_tree(grown)
    assert pressed[grown.joined].sum() == pressed[weighted_duotone(quads, pressed).joined].sum()


@pytest.mark.parametrize("tree", get_args(Tree))
@given(quads=MESHES, seed=seeds)
def test_locks_that_hold_nothing_change_nothing(tree: Tree, quads: QuadMesh, seed: int) -> None:
    plain = grown_duotone(quads, tree=tree, seed=seed).joined
    assert (grown_duotone(quads, tree=tree, seed=seed, locks=TileLocks.none(quads)).joined == plain).all()


@given(quads=MESHES, seed=seeds)
def test_breadth_first_depths_are_the_shortest_there_are(quads: QuadMesh, seed: int) -> None:
    root = seeded_root(quads, seed=seed)
    tree = joined_graph(breadth_first_duotone(quads, root=root), first=0)
    wanted = nx.single_source_shortest_path_length(diagonals(quads, first=0), root)
    assert dict(nx.single_source_shortest_path_length(tree, root)) == dict(wanted)


@given(quads=MESHES, seed=seeds)
def test_depth_first_leaves_no_tile_between_two_branches(quads: QuadMesh, seed: int) -> None:
    root = seeded_root(quads, seed=seed)
    tree = joined_graph(depth_first_duotone(quads, root=root), first=0)
    parent = nx.predecessor(tree, root)
    lines: dict[int, set[int]] = {}
    for point in nx.bfs_tree(tree, root):
        lines[point] = {point}.union(*(lines[above] for above in parent[point]))
    for a, b in diagonals(quads, first=0).edges():
        assert a in lines[b] or b in lines[a]


@pytest.mark.parametrize("tree", get_args(Tree))
@given(quads=MESHES, seed=seeds)
def test_trees_can_be_called_by_their_names(tree: Tree, quads: QuadMesh, seed: int) -> None:
    wanted = MAKERS[tree.replace("-", " ")](quads, seed)
    assert (grown_duotone(quads, tree=tree, seed=seed).joined == wanted.joined).all()


def test_depth_first_winds_where_breadth_first_radiates() -> None:
    quads = subdivided(named()["torus"], levels=2)
    root = seeded_root(quads, seed=3)
    makers = (breadth_first_duotone, depth_first_duotone)
    trees = [joined_graph(make(quads, root=root), first=0) for make in makers]
    wide, deep = (max(nx.single_source_shortest_path_length(tree, root).values()) for tree in trees)
    assert deep > 4 * wide


@given(quads=MESHES, seed=seeds)
def test_seeded_root_is_a_yellow_point(quads: QuadMesh, seed: int) -> None:
    root = seeded_root(quads, seed=seed)
    assert quads.yellow[root]
    assert root == seeded_root(quads, seed=seed)


def test_every_yellow_point_can_be_a_root() -> None:
    quads = NAMED["tetrahedron"]
    found = {seeded_root(quads, seed=seed) for seed in range(200)}
    assert found == set(np.flatnonzero(quads.yellow).tolist())


@pytest.mark.parametrize("make", [breadth_first_duotone, depth_first_duotone])
@pytest.mark.parametrize("root", [-1, 14, 8, 10_000])
def test_a_root_that_is_blue_or_nowhere_is_an_error(make: Callable[..., Duotone], root: int) -> None:
    quads = NAMED["tetrahedron"]  # 4 + 4 yellow points, then 6 blue ones
    with pytest.raises(PatternError, match=f"one of the 8 yellow points, found {root}"):
        make(quads, root=root)


@pytest.mark.parametrize("weights", [np.zeros(11), np.zeros((12, 1)), np.zeros(0)])
def test_there_is_one_weight_for_each_tile(weights: np.ndarray) -> None:
    with pytest.raises(PatternError, match="one finite weight for each of the 12 tiles"):
        weighted_duotone(NAMED["tetrahedron"], weights)


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf])
def test_weights_are_finite(wrong: float) -> None:
    weights = np.zeros(12)
    weights[5] = wrong
    with pytest.raises(PatternError, match="one finite weight for each of the 12 tiles"):
        weighted_duotone(NAMED["tetrahedron"], weights)
