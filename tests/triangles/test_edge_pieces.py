"""Distances between the ends of edges, against dense sampling and against known crossings."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import hull, on_sphere, seeds

from fabricate.triangles.edge_pieces import EdgePieces, near_edges
from fabricate.triangles.search_tree import SearchTree

DENSE = np.linspace(0.0, 1.0, 401)


def ball(seed: int, count: int) -> SearchTree:
    """Return the tree of a polyhedron inside the unit ball."""
    points = on_sphere(np.random.default_rng(seed).normal(size=(count, 3)))
    return SearchTree.of(points, hull(points).corners.reshape(-1, 3))


def random_edges(seed: int, count: int) -> tuple[np.ndarray, np.ndarray]:
    points = np.random.default_rng(seed).uniform(-2.0, 2.0, size=(2 * count, 3))
    return points, np.arange(2 * count).reshape(-1, 2)


def dense_distances(points: np.ndarray, edges: np.ndarray, other: SearchTree) -> np.ndarray:
    begins, ends = points[edges[:, 0], None], points[edges[:, 1], None]
    samples = begins + DENSE[:, None] * (ends - begins)
    return other.nearest(samples.reshape(-1, 3)).distance.reshape(len(edges), len(DENSE))


def measured(points: np.ndarray, edges: np.ndarray, other: SearchTree) -> EdgePieces:
    return EdgePieces.whole(points, edges, other.nearest(points).distance)


@given(shape=seeds, place=seeds, corners=st.integers(5, 20))
def test_no_place_of_an_edge_is_nearer_than_its_bound(shape: int, place: int, corners: int) -> None:
    other, (points, edges) = ball(shape, corners), random_edges(place, 30)
    dense = dense_distances(points, edges, other)
    assert (measured(points, edges, other).least <= dense.min(axis=1) + 1e-9).all()


def test_the_bound_is_met_where_two_edges_cross_at_right_angles() -> None:
    other = SearchTree.of(np.array([[0, -9, 0], [0, 9, 0], [0, 0, -9.0]]), np.array([[0, 1, 2]]))
    points = np.array([[-3.0, 0, 0.5], [2.0, 0, 0.5]])
    assert measured(points, np.array([[0, 1]]), other).least[0] == pytest.approx(0.5)


def test_the_bound_of_an_edge_without_length_is_its_distance() -> None:
    pieces = EdgePieces.whole(np.ones((2, 3)), np.array([[0, 1]]), np.array([0.7, 0.7]))
    assert pieces.least[0] == 0.7


@given(shape=seeds, place=seeds, reach=st.floats(0.05, 0.6))
def test_edges_are_near_if_and_only_if_a_place_between_their_ends_is(shape: int, place: int, reach: float) -> None:
    other, (points, edges) = ball(shape, 12), random_edges(place, 40)
    found = near_edges(measured(points, edges, other), other, reach=reach, sure=0.98 * reach)
    dense = dense_distances(points, edges, other)
    ends_far = dense[:, [0, -1]].min(axis=1) >= reach
    inner = dense.min(axis=1)
    must, may = ends_far & (inner < 0.98 * reach), ends_far & (inner < reach + 5.0 / len(DENSE))
    assert set(np.flatnonzero(must)) <= set(found.tolist()) <= set(np.flatnonzero(may))


def test_halves_are_the_same_edges_again_and_join_in_the_middle() -> None:
    other, (points, edges) = ball(0, 9), random_edges(1, 5)
    halves = measured(points, edges, other).halved(other)
    assert halves.edges.tolist() == [*range(5), *range(5)]
    np.testing.assert_array_equal(halves.ends[:5], halves.begins[5:])
    np.testing.assert_array_equal(halves.at_end[:5], halves.at_begin[5:])
    np.testing.assert_allclose(halves.at_end[:5], other.nearest(points[edges].mean(axis=1)).distance)
