from __future__ import annotations

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import directed_edges, hull, on_sphere, seeds, tetrahedron

from fabricate.triangles.adjacency import grown, neighbour_distances, neighbour_means, undirected_edges


@st.composite
def triangulations(draw: st.DrawFn) -> tuple[np.ndarray, int]:
    """Draw the triangles of a convex hull, and how many points it has."""
    rng, count = np.random.default_rng(draw(seeds)), draw(st.integers(4, 40))
    return hull(on_sphere(rng.normal(size=(count, 3)))).corners.reshape(-1, 3), count


def graph_of(triangles: np.ndarray) -> nx.Graph:
    return nx.Graph(directed_edges(triangles.tolist()))


@given(mesh=triangulations())
def test_every_edge_is_there_once(mesh: tuple[np.ndarray, int]) -> None:
    triangles, _ = mesh
    found = undirected_edges(triangles).tolist()
    assert len(found) == len(triangles) * 3 // 2
    assert {tuple(edge) for edge in found} == {tuple(sorted(edge)) for edge in graph_of(triangles).edges}


@given(mesh=triangulations(), seed=seeds)
def test_mean_is_that_over_the_neighbours(mesh: tuple[np.ndarray, int], seed: int) -> None:
    triangles, count = mesh
    values = np.random.default_rng(seed).normal(size=(count, 3))
    graph = graph_of(triangles)
    wanted = [values[list(graph[point])].mean(axis=0) for point in range(count)]
    np.testing.assert_allclose(neighbour_means(triangles, count=count) @ values, wanted, atol=1e-14)


@given(mesh=triangulations())
def test_rows_are_means_of_neighbours_alone(mesh: tuple[np.ndarray, int]) -> None:
    triangles, count = mesh
    means = neighbour_means(triangles, count=count)
    assert means.shape == (count, count)
    np.testing.assert_allclose(means.sum(axis=1), 1, atol=1e-14)
    assert means.diagonal().max() == 0
    assert means.nnz == triangles.size


@given(mesh=triangulations(), chosen=st.sets(st.integers(0, 39), max_size=3), rings=st.integers(0, 5))
def test_grown_reaches_as_many_edges_as_rings(mesh: tuple[np.ndarray, int], chosen: set[int], rings: int) -> None:
    triangles, count = mesh
    sources = {point for point in chosen if point < count}
    mask = np.isin(np.arange(count), sorted(sources))
    found = grown(mask, neighbour_means(triangles, count=count), rings)
    reach = nx.multi_source_dijkstra_path_length(graph_of(triangles), sources) if sources else {}
    assert set(np.flatnonzero(found).tolist()) == {point for point, far in reach.items() if far <= rings}


def test_the_mask_given_is_left_alone() -> None:
    triangles = tetrahedron().corners.reshape(-1, 3)
    mask = np.array([True, False, False, False])
    assert grown(mask, neighbour_means(triangles, count=4), 2).all()
    assert mask.tolist() == [True, False, False, False]


@pytest.mark.parametrize("state", [True, False])
def test_all_and_nothing_stay_what_they_are(state: bool) -> None:
    triangles = tetrahedron().corners.reshape(-1, 3)
    mask = np.full(4, state)
    assert (grown(mask, neighbour_means(triangles, count=4), 3) == mask).all()


@given(mesh=triangulations(), seed=seeds)
def test_neighbours_are_as_far_as_their_mean_distance(mesh: tuple[np.ndarray, int], seed: int) -> None:
    triangles, count = mesh
    points = np.random.default_rng(seed).normal(size=(count, 3))
    graph = graph_of(triangles)
    wanted = [np.linalg.norm(points[list(graph[point])] - points[point], axis=1).mean() for point in range(count)]
    np.testing.assert_allclose(neighbour_distances(points, triangles), wanted)
