"""Sharp edges: found where they are, and kept by new triangles, so that a polyhedron stays what it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from creases import bracket

from fabricate.mesh.closed import signed_volume
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.prepare.remesh import remeshed
from fabricate.prepare.sharp_edges import SharpEdges, sharpened
from fabricate.prepare.triangle_mesh import fanned

BODIES = {"cube": (cube(divisions=2).scaled(15.0), 8, 360.0), "bracket": (bracket().scaled(7.0), 12, 504.0)}
"""Bodies, mm, with the number of their corners and the length of all edges."""


def lengths(segments: np.ndarray) -> float:
    return float(np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1).sum())


@pytest.mark.parametrize("name", BODIES)
def test_edges_and_corners_are_those_of_the_polyhedron(name: str) -> None:
    mesh, corners, total = BODIES[name]
    found = SharpEdges.of(mesh, angle=40.0)
    assert lengths(found.segments) == pytest.approx(total)
    assert len(found.corners) == corners
    nothing = SharpEdges.of(mesh, angle=91.0)
    assert (len(nothing.segments), len(nothing.corners)) == (0, 0)


def test_the_nearest_place_is_that_of_many_samples() -> None:
    found = SharpEdges.of(BODIES["bracket"][0], angle=40.0)
    places = np.random.default_rng(1).uniform(-40.0, 40.0, (200, 3))
    share = np.linspace(0.0, 1.0, 2001)[:, None, None]
    samples = ((1.0 - share) * found.segments[:, 0] + share * found.segments[:, 1]).reshape(-1, 3)
    nearest = np.linalg.norm(found.nearest(places) - places, axis=1)
    wanted = [np.linalg.norm(samples - place, axis=1).min() for place in places]
    np.testing.assert_allclose(nearest, wanted, atol=1e-3)


@pytest.mark.parametrize("name", BODIES)
def test_new_triangles_keep_a_polyhedron_exactly(name: str) -> None:
    mesh, corners, total = BODIES[name]
    made = remeshed(mesh, cells="triangles", tile_size=3.0, seed=1, crease=40.0)
    assert made.notes == ()
    assert signed_volume(made.mesh) == pytest.approx(signed_volume(mesh), rel=1e-9)
    kept = SharpEdges.of(made.mesh, angle=40.0)
    assert lengths(kept.segments) == pytest.approx(total)
    assert len(kept.corners) == corners
    assert made.mesh.creases.sum() >= 2 * len(kept.segments)


def test_without_a_crease_edges_are_cut_off() -> None:
    mesh = BODIES["cube"][0]
    made = remeshed(mesh, cells="triangles", tile_size=3.0, seed=1)
    assert not made.mesh.creases.any()
    assert abs(signed_volume(made.mesh) / signed_volume(mesh) - 1.0) > 1e-6


def test_a_surface_without_sharp_edges_changes_nothing() -> None:
    ball = fanned(sphere(faces="triangles", frequency=4))
    same = sharpened(ball, ball, angle=40.0)
    assert same.points is ball.points
    assert not same.creases.any()


def test_points_far_from_any_edge_stay() -> None:
    surface = fanned(cube(divisions=4))
    lifted = surface.points + 1e-3 * np.sign(surface.points) * (np.abs(surface.points) == 1.0)
    found: PolygonMesh = sharpened(replace(surface, points=lifted), surface, angle=40.0)
    np.testing.assert_allclose(found.points, surface.points, atol=1e-12)
