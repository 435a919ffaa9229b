from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import hull, on_sphere, seeds

from fabricate.mesh.sphere import geodesic_sphere
from fabricate.triangles.ray_casting import first_hits

SQUARE = np.array([[0.0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]])
HALVES = np.array([[0, 1, 2], [0, 2, 3]])


def naive_hits(corners: np.ndarray, origin: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Return the distance to each triangle, inf where the ray misses it: Moeller and Trumbore, 1997."""
    a, b, c = np.moveaxis(corners, 1, 0)
    across = np.cross(direction, c - a)
    scale = np.einsum("ij,ij->i", b - a, across)
    from_a = origin - a
    u = np.einsum("ij,ij->i", from_a, across) / scale
    sideways = np.cross(from_a, b - a)
    v = sideways @ direction / scale
    distance = np.einsum("ij,ij->i", c - a, sideways) / scale
    return np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (distance > 0), distance, np.inf)


@given(seed=seeds, count=st.integers(4, 40))
def test_hits_are_those_of_trying_every_triangle(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    mesh = hull(on_sphere(rng.normal(size=(count, 3))))
    triangles = mesh.corners.reshape(-1, 3)
    origins, directions = rng.normal(size=(50, 3)), on_sphere(rng.normal(size=(50, 3)))
    found = first_hits(mesh.points, triangles, origins, directions)
    for ray in range(50):
        wanted = naive_hits(mesh.points[triangles], origins[ray], directions[ray])
        if found.triangle[ray] != wanted.argmin() and wanted.min() < np.inf:  # on a common edge
            assert wanted.min() == pytest.approx(found.distance[ray], rel=1e-4)
        assert found.distance[ray] == pytest.approx(wanted.min(), rel=1e-4, abs=1e-5)
        assert (found.triangle[ray] == -1) == (wanted.min() == np.inf)


def test_either_side_of_a_triangle_counts() -> None:
    origins = np.array([[3.0, 1, 5], [1.0, 3, -2]])
    directions = np.array([[0.0, 0, -1], [0, 0, 1]])
    found = first_hits(SQUARE, HALVES, origins, directions)
    assert found.triangle.tolist() == [0, 1]
    np.testing.assert_allclose(found.distance, [5, 2], rtol=1e-6)


def test_rays_that_meet_nothing() -> None:
    origins = np.array([[1.0, 1, 5], [9, 9, 5], [1, 1, 5]])
    directions = np.array([[0.0, 0, 1], [0, 0, -1], [1, 0, 0]])
    found = first_hits(SQUARE, HALVES, origins, directions)
    assert found.triangle.tolist() == [-1, -1, -1]
    assert found.distance.tolist() == [np.inf] * 3
    assert found.triangle.dtype == np.int64
    assert found.distance.dtype == np.float64


def test_the_nearer_of_two_walls_is_hit() -> None:
    up = np.array([0.0, 0, 1])
    walls = np.concatenate([SQUARE + up, SQUARE + 2 * up])
    triangles = np.concatenate([HALVES, HALVES + 4])
    found = first_hits(walls, triangles, np.array([[3.0, 1, 0], [3, 1, 3]]), np.stack([up, -up]))
    assert found.triangle.tolist() == [0, 2]
    np.testing.assert_allclose(found.distance, 1, rtol=1e-6)


def test_from_the_centre_of_a_sphere_everything_is_one_radius_away() -> None:
    mesh = geodesic_sphere(frequency=16).scaled(50)
    directions = on_sphere(np.random.default_rng(2).normal(size=(2000, 3)))
    found = first_hits(mesh.points, mesh.corners.reshape(-1, 3), np.zeros_like(directions), directions)
    assert (found.triangle >= 0).all()
    np.testing.assert_allclose(found.distance, 50, rtol=2e-3)


def test_arrays_that_are_not_contiguous_are_read_right() -> None:
    origins = np.array([[3.0, 1, 5], [1.0, 3, 5]]).T.copy().T
    directions = np.zeros((4, 3))[::2] - [0, 0, 1]
    found = first_hits(SQUARE, HALVES, origins, directions)
    assert found.triangle.tolist() == [0, 1]
