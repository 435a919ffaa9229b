"""Thickness that varies: from end to end by height, and thin where the surface bends."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus
from fabricate.solid.settling import fitted_cut
from fabricate.solid.solids import solids
from fabricate.solid.thickness import point_bends, varying_thickness
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled
from fabricate.triangles.crossing import crossing_triangles


def cut_surface(mesh: PolygonMesh) -> CutSurface:
    duotone = grown_duotone(tiled(sized(mesh, size=60), tile_size=10), tree="random", seed=3)
    return fitted_cut(duotone, tolerance=0.3, clearance=0.3)


@pytest.fixture(scope="module")
def ring() -> CutSurface:
    return cut_surface(torus(around=16, across=8, tube=0.45))


def test_by_height_it_falls_evenly_from_the_bottom_to_the_top(ring: CutSurface) -> None:
    thickness = varying_thickness(ring, thinnest=1.5, thickest=3.0, by="height")
    height = ring.points[:, 2]
    assert thickness[height.argmin()] == 3.0
    assert thickness[height.argmax()] == 1.5
    rise = (thickness - 3.0) / (height - height.min() + 1e-9)
    np.testing.assert_allclose(rise[height > height.min() + 1], -1.5 / np.ptp(height), rtol=1e-6)


def test_by_curvature_the_outside_of_a_ring_is_thin_and_its_flattest_part_thick() -> None:
    """An ellipsoid with axes 1, 1, 0.4 bends most at its rim and least at its poles."""
    mesh = sphere(faces="triangles", frequency=2)
    surface = cut_surface(mesh.moved(mesh.points * [1.0, 1.0, 0.4]))
    thickness = varying_thickness(surface, thinnest=1.5, thickest=3.0, by="curvature")
    around = np.linalg.norm(surface.points[:, :2], axis=1)
    assert (thickness[around < 5.0] > 2.7).all()
    assert (thickness[around > 29.5] < 1.8).all()
    assert thickness.min() == 1.5
    assert thickness.max() == 3.0


def test_a_sphere_that_bends_alike_everywhere_is_thick_everywhere() -> None:
    surface = cut_surface(sphere(faces="triangles", frequency=4))
    thickness = varying_thickness(surface, thinnest=1.5, thickest=3.0, by="curvature")
    assert np.median(thickness) > 2.8
    assert np.median(point_bends(surface)) == pytest.approx(1 / 30, rel=0.02)


def test_solids_are_as_thick_as_asked_at_each_point(ring: CutSurface) -> None:
    asked = varying_thickness(ring, thinnest=1.5, thickest=3.0, by="height")
    made = solids(ring, thickness=asked, clearance=0.3)
    n = len(ring.points)
    inner = made.points[np.unique(made.shell)].reshape(2, n, 3)[1]
    depth = np.linalg.norm(inner - ring.points, axis=1)
    assert np.quantile(np.abs(depth - asked), 0.99) < 0.1
    assert len(crossing_triangles(made.points, np.concatenate(made.bodies))) == 0
