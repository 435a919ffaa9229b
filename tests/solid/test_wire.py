"""Wires: sound where they fit, refused with the thickest that does where they do not."""

from __future__ import annotations

import re

import numpy as np
import pytest

from fabricate.checks.geometry import signed_volume
from fabricate.checks.topology import topology
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.errors import SolidError
from fabricate.mesh.crease import creased
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.solid.settling import fitted_cut
from fabricate.solid.wire import Wire, wire
from fabricate.surface.neck import tile_necks
from fabricate.surface.sizing import sized, tiled
from fabricate.triangles.crossing import crossing_triangles


def ring(radius: float) -> np.ndarray:
    angle = np.linspace(0, 2 * np.pi, 100, endpoint=False)
    return radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)


def assert_sound(made: Wire) -> None:
    connected = topology(made.part, expected_genus=1)
    assert not [check.message for check in connected.checks if not check.ok]
    assert not len(crossing_triangles(made.part.points, made.part.triangles))


def thickest(error: SolidError) -> float:
    found = re.search(r"at most (\S+) mm", str(error))
    assert found is not None, str(error)
    return float(found[1])


def test_a_ring_has_the_volume_of_a_torus() -> None:
    made = wire(ring(20), diameter=4, tolerance=0.002)
    assert_sound(made)
    assert signed_volume(made.part) == pytest.approx(2 * np.pi**2 * 20 * 2**2, rel=2e-3)
    assert made.length == pytest.approx(40 * np.pi, rel=1e-3)


@pytest.mark.parametrize("diameter", [41.0, 45.0, 1e6])
def test_a_ring_can_be_nearly_as_thick_as_it_is_wide(diameter: float) -> None:
    with pytest.raises(SolidError, match="touch itself") as caught:
        wire(ring(20), diameter=diameter, tolerance=0.05)
    assert 36 < thickest(caught.value) <= 40


@pytest.mark.parametrize("mesh", [geodesic_sphere(frequency=1), creased(cube(divisions=2), angle=40)])
def test_a_curve_over_a_surface_makes_a_wire_as_thick_as_its_necks_allow(mesh: PolygonMesh) -> None:
    duotone = grown_duotone(tiled(sized(mesh, size=40), tile_size=7), tree="random", seed=4)
    surface = fitted_cut(duotone, tolerance=0.1)
    curve = surface.points[surface.curves[0]]
    assert_sound(wire(curve, diameter=0.8, tolerance=0.05))
    with pytest.raises(SolidError) as caught:
        wire(curve, diameter=8, tolerance=0.05)
    largest = thickest(caught.value)
    assert 0.8 < largest <= tile_necks(surface)[0].min() * 1.05
    assert_sound(wire(curve, diameter=largest, tolerance=0.05))
    with pytest.raises(SolidError, match="touch itself"):
        wire(curve, diameter=1.15 * largest, tolerance=0.05)


def test_the_same_curve_gives_the_same_wire() -> None:
    one, other = (wire(ring(9), diameter=1, tolerance=0.05).part for _ in range(2))
    assert one.points.tobytes() == other.points.tobytes()
    assert one.triangles.tobytes() == other.triangles.tobytes()
