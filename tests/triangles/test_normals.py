from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from polyhedra import hull, octahedron, on_sphere, seeds

from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.triangles.normals import area_vectors, mean_normals, point_areas, unit, vertex_normals


@st.composite
def bodies(draw: st.DrawFn) -> PolygonMesh:
    rng = np.random.default_rng(draw(seeds))
    return hull(on_sphere(rng.normal(size=(draw(st.integers(4, 30)), 3))))


def normals_of(mesh: PolygonMesh) -> np.ndarray:
    return vertex_normals(mesh.points, mesh.corners.reshape(-1, 3))


@given(mesh=bodies())
def test_normals_are_sums_of_triangle_normals_weighted_by_area(mesh: PolygonMesh) -> None:
    wanted = np.zeros_like(mesh.points)
    for triangle in mesh.corners.reshape(-1, 3).tolist():
        a, b, c = mesh.points[triangle]
        for point in triangle:
            wanted[point] += np.cross(b - a, c - a)
    wanted /= np.linalg.norm(wanted, axis=1, keepdims=True)
    np.testing.assert_allclose(normals_of(mesh), wanted, atol=1e-12)


@given(mesh=bodies(), factor=st.floats(1e-3, 1e3), seed=seeds)
def test_normals_turn_with_the_body_and_feel_no_size(mesh: PolygonMesh, factor: float, seed: int) -> None:
    rotation = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    rotation *= np.sign(np.linalg.det(rotation))
    turned = mesh.moved(factor * mesh.points @ rotation + 5)
    np.testing.assert_allclose(normals_of(turned), normals_of(mesh) @ rotation, atol=1e-9)


@given(mesh=bodies())
def test_a_body_turned_inside_out_has_opposite_normals(mesh: PolygonMesh) -> None:
    reversed_triangles = mesh.corners.reshape(-1, 3)[:, ::-1]
    found = vertex_normals(mesh.points, reversed_triangles)
    np.testing.assert_allclose(found, -normals_of(mesh), atol=1e-12)


def test_normals_of_an_octahedron_are_its_points() -> None:
    np.testing.assert_allclose(normals_of(octahedron()), octahedron().points, atol=1e-15)


def test_normals_of_spheres_approach_the_radii() -> None:
    spheres = [geodesic_sphere(frequency=frequency) for frequency in (4, 8, 16)]
    worst = [np.linalg.norm(normals_of(mesh) - mesh.points, axis=1).max() for mesh in spheres]
    assert worst[0] < 0.05
    assert worst == sorted(worst, reverse=True)


@given(vectors=arrays(np.float64, (5, 3), elements=st.floats(-1e6, 1e6)))
def test_unit_keeps_directions_and_only_zero_stays_short(vectors: np.ndarray) -> None:
    found = unit(vectors)
    length = np.linalg.norm(vectors, axis=1)
    sound = length > 1e-150
    np.testing.assert_allclose(np.linalg.norm(found[sound], axis=1), 1, rtol=1e-12)
    np.testing.assert_allclose(found[sound] * length[sound, None], vectors[sound], rtol=1e-12, atol=1e-300)
    zero = (vectors == 0).all(axis=1)
    assert (found[zero] == 0).all()


@pytest.mark.parametrize("shape", [(0, 3), (1, 3)])
def test_zero_vectors_give_no_warning(shape: tuple[int, int]) -> None:
    with np.errstate(all="raise"):
        assert (unit(np.zeros(shape)) == 0).all()


@given(mesh=bodies())
def test_mean_normals_count_each_triangle_once_whatever_its_size(mesh: PolygonMesh) -> None:
    wanted = np.zeros_like(mesh.points)
    for triangle in mesh.corners.reshape(-1, 3).tolist():
        a, b, c = mesh.points[triangle]
        wanted[triangle] += unit(np.cross(b - a, c - a)[None])
    np.testing.assert_allclose(mean_normals(mesh.points, mesh.corners.reshape(-1, 3)), unit(wanted), atol=1e-9)


@given(mesh=bodies())
def test_the_areas_of_all_points_add_up_to_the_surface(mesh: PolygonMesh) -> None:
    triangles = mesh.corners.reshape(-1, 3)
    areas = point_areas(mesh.points, triangles)
    assert (areas > 0).all()
    assert areas.sum() == pytest.approx(np.linalg.norm(area_vectors(mesh.points, triangles), axis=1).sum() / 2)
