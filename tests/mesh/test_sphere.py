from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shape_oracles import crossings

from fabricate.errors import MeshError
from fabricate.mesh.closed import checked_closed, genus, signed_volume
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import (
    dodecahedron,
    geodesic_sphere,
    sphere,
    truncated_cuboctahedron,
    truncated_icosahedron,
)


@dataclass(frozen=True)
class Solid:
    """A polyhedron with the figures that tables give for edge length 1."""

    make: Callable[[], PolygonMesh]
    points: int
    faces: dict[int, int]
    radius: float
    volume: float


SOLIDS = [
    Solid(lambda: geodesic_sphere(frequency=1), 12, {3: 20}, (10 + 2 * 5**0.5) ** 0.5 / 4, 5 * (3 + 5**0.5) / 12),
    Solid(dodecahedron, 20, {5: 12}, 3**0.5 * (1 + 5**0.5) / 4, (15 + 7 * 5**0.5) / 4),
    Solid(truncated_icosahedron, 60, {5: 12, 6: 20}, (58 + 18 * 5**0.5) ** 0.5 / 4, (125 + 43 * 5**0.5) / 4),
    Solid(truncated_cuboctahedron, 48, {4: 12, 6: 8, 8: 6}, (13 + 6 * 2**0.5) ** 0.5 / 2, 22 + 14 * 2**0.5),
]


def edge_lengths(mesh: PolygonMesh) -> np.ndarray:
    return np.linalg.norm(mesh.points[mesh.corners[mesh.next_corner]] - mesh.points[mesh.corners], axis=1)


def triangle_areas(mesh: PolygonMesh) -> np.ndarray:
    a, b, c = np.moveaxis(mesh.points[mesh.corners.reshape(-1, 3)], 1, 0)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


@pytest.mark.parametrize("solid", SOLIDS)
def test_solid_has_the_faces_edges_and_volume_of_the_tables(solid: Solid) -> None:
    mesh = solid.make()
    sizes, counts = np.unique(mesh.face_sizes, return_counts=True)
    assert dict(zip(sizes.tolist(), counts.tolist(), strict=True)) == solid.faces
    assert len(mesh.points) == solid.points
    np.testing.assert_allclose(edge_lengths(mesh), 1 / solid.radius, rtol=1e-12)
    assert signed_volume(mesh) == pytest.approx(solid.volume / solid.radius**3, rel=1e-12)


@pytest.mark.parametrize("solid", SOLIDS)
def test_solid_is_closed_outward_and_round_the_origin(solid: Solid) -> None:
    mesh = solid.make()
    assert checked_closed(mesh) is mesh
    assert genus(mesh) == 0
    assert crossings(mesh) == 0
    np.testing.assert_allclose(np.linalg.norm(mesh.points, axis=1), 1, rtol=1e-14)
    np.testing.assert_allclose(mesh.points.mean(axis=0), 0, atol=1e-14)


@pytest.mark.parametrize("solid", SOLIDS)
def test_faces_of_a_solid_are_flat_and_below_them_lies_everything_else(solid: Solid) -> None:
    mesh = solid.make()
    for begin, end in zip(mesh.offsets, mesh.offsets[1:], strict=False):
        corners = mesh.points[mesh.corners[begin:end]]
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[1])
        heights = (mesh.points - corners[0]) @ normal
        np.testing.assert_allclose(heights[mesh.corners[begin:end]], 0, atol=1e-14)
        assert np.sum(heights > -1e-9) == end - begin


@given(frequency=st.integers(1, 12))
def test_geodesic_sphere_follows_its_counts(frequency: int) -> None:
    mesh = geodesic_sphere(frequency=frequency)
    assert len(mesh.points) == 10 * frequency**2 + 2
    assert mesh.face_sizes.tolist() == [3] * (20 * frequency**2)
    valences, counts = np.unique(np.bincount(mesh.corners), return_counts=True)
    assert counts[valences == 5] == [12]
    assert set(valences.tolist()) <= {5, 6}


@given(frequency=st.integers(1, 12))
def test_geodesic_sphere_is_closed_outward_and_round_the_origin(frequency: int) -> None:
    mesh = geodesic_sphere(frequency=frequency)
    assert checked_closed(mesh) is mesh
    assert genus(mesh) == 0
    assert crossings(mesh) == 0
    np.testing.assert_allclose(np.linalg.norm(mesh.points, axis=1), 1, rtol=1e-14)
    np.testing.assert_allclose(mesh.points.mean(axis=0), 0, atol=1e-14)


def test_volume_of_geodesic_spheres_converges_quadratically() -> None:
    missing = [4 / 3 * np.pi - signed_volume(geodesic_sphere(frequency=f)) for f in (8, 16, 32)]
    orders = np.log2(np.array(missing[:-1]) / missing[1:])
    np.testing.assert_allclose(orders, 2, atol=0.05)


@pytest.mark.parametrize("frequency", [2, 3, 8, 20])
def test_geodesic_triangles_are_of_nearly_one_size(frequency: int) -> None:
    areas = triangle_areas(geodesic_sphere(frequency=frequency))
    assert areas.max() / areas.min() < 1.25


def test_edges_of_the_icosahedron_are_divided_into_equal_arcs() -> None:
    mesh = geodesic_sphere(frequency=5)
    arcs = 2 * np.arcsin(edge_lengths(mesh) / 2)
    part = np.arccos(1 / 5**0.5) / 5
    assert np.isclose(arcs, part, rtol=1e-12).sum() >= 2 * 30 * 5


def test_each_kind_of_face_gives_its_sphere() -> None:
    largest = {
        "triangles": 3,
        "pentagons": 5,
        "hexagons": 6,
        "octagons": 8,
    }
    found = {kind: int(sphere(faces=kind).face_sizes.max()) for kind in largest}  # type: ignore[arg-type]
    assert found == largest
    assert len(sphere(faces="triangles", frequency=4).points) == 162


@pytest.mark.parametrize("frequency", [0, -3])
def test_frequency_below_one_is_an_error(frequency: int) -> None:
    with pytest.raises(MeshError, match=f"frequency must be 1 or more, found {frequency}"):
        geodesic_sphere(frequency=frequency)


def test_only_triangles_can_be_divided() -> None:
    with pytest.raises(MeshError, match="only triangles can be divided, found frequency 2 for hexagons"):
        sphere(faces="hexagons", frequency=2)


def test_unknown_faces_are_an_error() -> None:
    with pytest.raises(MeshError, match="triangles, pentagons, hexagons, octagons, found 'heptagons'"):
        sphere(faces="heptagons")  # type: ignore[arg-type]
