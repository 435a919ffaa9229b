"""Thin handles are cut away and narrow holes filled, and nothing else is."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.arrays import Floats
from fabricate.mesh.closed import checked_closed, genus, signed_volume
from fabricate.mesh.pierced import double_torus
from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus
from fabricate.prepare.soundness import crossing_faces
from fabricate.prepare.thin_handles import without_thin_handles
from fabricate.prepare.triangle_mesh import TriangleMesh, fanned

RADIUS = 20.0


def ring(tube_at: Floats) -> TriangleMesh:
    """Return a ring of radius 20 mm whose tube has the radii given, (k,), mm, one for each section round the axis."""
    across, around = 16, len(tube_at)
    about = np.linspace(0.0, 2.0 * np.pi, around, endpoint=False)[:, None]
    tube = np.linspace(0.0, 2.0 * np.pi, across, endpoint=False)
    out = RADIUS + tube_at[:, None] * np.cos(tube)
    points = np.stack(
        [out * np.cos(about), out * np.sin(about), tube_at[:, None] * np.sin(tube) * np.ones_like(about)], axis=2
    )
    return fanned(torus(around=around, across=across, tube=0.2).moved(points.reshape(-1, 3)))


def narrowed(*, places: int) -> TriangleMesh:
    """Return a ring with a tube of radius 5 mm that is 0.8 mm at some places along a twentieth of the ring each."""
    about = np.linspace(0.0, 1.0, 240, endpoint=False)
    away = np.min([np.abs((about - k / places + 0.5) % 1.0 - 0.5) for k in range(places)], axis=0)
    return ring(np.clip(0.8 + 100.0 * (away - 0.025), 0.8, 5.0))


def test_a_ring_is_cut_where_it_is_thin_and_what_is_thin_goes() -> None:
    given = narrowed(places=1)
    found = without_thin_handles(given, thinnest=2.0)
    assert genus(checked_closed(found.surface.polygons)) == 0
    assert len(crossing_faces(found.surface.polygons)) == 0
    assert 0.99 < signed_volume(found.surface.polygons) / signed_volume(given.polygons) < 1.0
    at_thinnest = np.linalg.norm(found.surface.points - [RADIUS, 0.0, 0.0], axis=1)
    assert at_thinnest.min() > 1.0
    (note,) = found.notes
    assert note.startswith("the genus became 0 instead of 1: handles thinner and holes narrower than 2 mm, one at (")


def test_a_ring_that_is_thin_at_two_places_keeps_both_halves() -> None:
    given = narrowed(places=2)
    found = without_thin_handles(given, thinnest=2.0)
    assert genus(checked_closed(found.surface.polygons)) == 0
    assert signed_volume(found.surface.polygons) > 0.97 * signed_volume(given.polygons)


def test_a_narrow_hole_is_filled() -> None:
    given = ring(np.full(120, RADIUS - 0.7))
    found = without_thin_handles(given, thinnest=2.0)
    assert genus(checked_closed(found.surface.polygons)) == 0
    assert signed_volume(found.surface.polygons) > signed_volume(given.polygons)


@pytest.mark.parametrize("radius", [1.5, 5.0, RADIUS - 1.5])
def test_handles_and_holes_that_are_wide_enough_stay(radius: float) -> None:
    given = ring(np.full(240, radius))
    found = without_thin_handles(given, thinnest=2.0)
    assert found.surface is given
    assert found.notes == ()


def test_all_handles_of_a_small_frame_go_and_the_body_stays_one() -> None:
    given = fanned(double_torus().scaled(1.0))
    found = without_thin_handles(given, thinnest=100.0)
    assert genus(checked_closed(found.surface.polygons)) == 0


def test_balls_have_no_handles_however_small() -> None:
    given = fanned(sphere(faces="triangles", frequency=3))
    assert without_thin_handles(given, thinnest=10.0).surface is given
