"""Distances: against the formula for a box, and against every triangle tried in turn."""

from __future__ import annotations

import igl
import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fabricate.arrays import Floats, Indices
from fabricate.triangles.search_tree import SearchTree

queries = arrays(np.float64, st.tuples(st.integers(1, 20), st.just(3)), elements=st.floats(-5.0, 5.0))


def box() -> tuple[Floats, Indices]:
    mesh = trimesh.creation.box((2, 2, 2))
    return np.array(mesh.vertices), np.array(mesh.faces)


def distance_to_box(points: Floats) -> Floats:
    """Return the distance to the surface of the cube from -1 to 1."""
    outside = np.linalg.norm(np.maximum(np.abs(points) - 1.0, 0.0), axis=1)
    inside = 1.0 - np.abs(points).max(axis=1)
    result: Floats = np.where(inside > 0.0, inside, outside)
    return result


@given(queries)
def test_distance_to_a_box(points: Floats) -> None:
    found = SearchTree.of(*box()).nearest(points)
    assert found.distance == pytest.approx(distance_to_box(points), abs=1e-9)
    assert found.distance == pytest.approx(np.linalg.norm(points - found.point, axis=1), abs=1e-9)
    assert found.distance.shape == found.triangle.shape == (len(points),)
    assert found.point.shape == (len(points), 3)


def test_the_nearest_triangle_holds_the_nearest_point() -> None:
    mesh = trimesh.creation.icosphere(subdivisions=2, radius=10)
    vertices, triangles = np.array(mesh.vertices), np.array(mesh.faces)
    points = np.random.default_rng(5).uniform(-15, 15, (50, 3))
    found = SearchTree.of(vertices, triangles).nearest(points)
    corners = vertices[triangles[found.triangle]]
    own = [
        igl.point_simplex_squared_distance(point, three, np.array([[0, 1, 2]]), 0)[0]
        for point, three in zip(points, corners, strict=True)
    ]
    assert np.sqrt(own) == pytest.approx(found.distance)


def test_no_queries_no_answers() -> None:
    assert len(SearchTree.of(*box()).nearest(np.zeros((0, 3))).distance) == 0
