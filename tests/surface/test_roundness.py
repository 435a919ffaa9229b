"""Spheres become round on the limit surface, by moving points along their rays and nothing else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.duotone.catmull_clark import catmull_clark
from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
from fabricate.mesh.closed import checked_closed, genus
from fabricate.mesh.half_edges import half_edges
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import SphereFaces, sphere
from fabricate.surface.limit import limit_vertices
from fabricate.surface.roundness import polygons, rounded

SPHERES: list[tuple[SphereFaces, int, float]] = [
    ("triangles", 1, 0.003),
    ("triangles", 2, 0.003),
    ("triangles", 7, 0.003),
    ("pentagons", 1, 0.003),
    ("hexagons", 1, 0.003),
    ("octagons", 1, 0.01),
]


def quads_of(faces: SphereFaces, frequency: int = 1) -> QuadMesh:
    return catmull_clark(sphere(faces=faces, frequency=frequency)).mesh


def unroundness(quads: QuadMesh) -> float:
    """Return by how much the distance of limit points from the origin differs from 1, at 20 000 of them."""
    while len(quads.points) < 20_000:
        quads = catmull_clark(quads).mesh
    return float(np.abs(np.linalg.norm(limit_vertices(quads), axis=1) - 1).max())


@pytest.mark.parametrize(("faces", "frequency", "tolerance"), SPHERES)
def test_the_limit_of_a_sphere_becomes_round(faces: SphereFaces, frequency: int, tolerance: float) -> None:
    assert unroundness(rounded(quads_of(faces, frequency))) < tolerance


def test_octagons_were_dented_and_the_measure_sees_it() -> None:
    quads = quads_of("octagons")
    distance = np.linalg.norm(limit_vertices(quads), axis=1)
    assert 1 - distance.min() / distance.max() > 0.1
    assert unroundness(quads) > 0.1


@pytest.mark.parametrize(("faces", "frequency", "_"), SPHERES)
def test_points_move_along_their_rays_and_quads_stay(faces: SphereFaces, frequency: int, _: float) -> None:
    quads = quads_of(faces, frequency)
    moved = rounded(quads)
    for name in ("tiles", "twins", "yellow"):
        np.testing.assert_array_equal(getattr(moved, name), getattr(quads, name))
    np.testing.assert_allclose(np.cross(moved.points, quads.points), 0, atol=1e-12)
    assert (np.einsum("ij,ij->i", moved.points, quads.points) > 0).all()
    assert genus(checked_closed(polygons(moved))) == 0


@given(scale=st.floats(1e-3, 1e3))
def test_the_size_it_had_does_not_matter(scale: float) -> None:
    mesh = sphere(faces="pentagons")
    points = rounded(catmull_clark(mesh).mesh).points
    scaled = rounded(catmull_clark(mesh.scaled(scale)).mesh)
    np.testing.assert_allclose(scaled.points, points, rtol=0, atol=1e-12)


def test_polygons_are_the_quads_with_their_half_edges() -> None:
    smooth = quads_of("hexagons")
    quads = replace(smooth, creases=smooth.half_edges.edge % 3 == 0)
    mesh = polygons(quads)
    assert isinstance(mesh, PolygonMesh)
    assert checked_closed(mesh) is mesh
    connectivity = half_edges(mesh)
    for name in ("tail", "following", "preceding", "face", "twin"):
        np.testing.assert_array_equal(getattr(connectivity, name), getattr(quads.half_edges, name))
    again = two_coloured(mesh)
    for name in ("points", "tiles", "twins", "yellow", "creases"):
        np.testing.assert_array_equal(getattr(again, name), getattr(quads, name))
