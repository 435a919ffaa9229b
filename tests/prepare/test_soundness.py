"""Own check of cells: each fault is caught, and sound cells pass."""

from __future__ import annotations

import numpy as np
import pytest
from polyhedra import HANDLES

from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.prepare.soundness import bridges, crossing_faces, distances, fault, lost, topology_fault
from fabricate.prepare.triangle_mesh import fanned

BALL = sphere(faces="triangles", frequency=6)


def pushed_through(mesh: PolygonMesh) -> PolygonMesh:
    """Return the mesh with its topmost point moved to below the bottom."""
    points = np.array(mesh.points)
    points[points[:, 2].argmax(), 2] = -2.0
    return mesh.moved(points)


@pytest.mark.parametrize("name", HANDLES)
def test_sound_cells_pass(name: str) -> None:
    mesh, handles = HANDLES[name]
    assert topology_fault(mesh, handles=handles) is None
    assert fault(cube(divisions=2), handles=0) is None


def test_a_hole_is_a_fault() -> None:
    mesh = cube(divisions=2)
    open_mesh = PolygonMesh(mesh.points, mesh.corners[4:], mesh.offsets[:-1])
    assert "open boundary" in str(fault(open_mesh, handles=0))


def test_another_genus_is_a_fault() -> None:
    assert fault(HANDLES["double torus"][0], handles=3) == "the genus became 2 instead of 3"


def test_a_crossing_is_a_fault_but_not_of_topology() -> None:
    assert "cross each other" in str(fault(pushed_through(BALL), handles=0))
    assert topology_fault(pushed_through(BALL), handles=0) is None
    assert len(crossing_faces(BALL)) == 0


def test_distances_from_a_cube_are_known() -> None:
    half = float(cube(divisions=1).points.max())
    places = np.array([[0, 0, half + 2.0], [0, 0, 0], [half, half, half], [half + 1, half + 1, half + 1]])
    assert distances(cube(divisions=1), places) == pytest.approx([2, half, 0, np.sqrt(3)], abs=1e-12)


def test_a_lost_part_is_found_where_it_was() -> None:
    surface = fanned(BALL)
    flat = BALL.moved(np.minimum(BALL.points, [2, 2, 0.5]))
    found = lost(flat, surface, reach=0.25)
    assert (surface.points[found][:, 2] > 0.75).all()
    assert (surface.points[~found][:, 2] <= 0.75 + 1e-9).all()
    assert found.any()


def test_a_few_lost_points_are_none() -> None:
    surface = fanned(sphere(faces="triangles", frequency=24))
    points = np.array(surface.points)
    points[0] *= 1.5
    spiked = fanned(surface.polygons.moved(points))
    assert distances(surface.polygons, spiked.points).max() > 0.4
    assert not lost(surface.polygons, spiked, reach=0.1).any()


def test_an_edge_through_a_plate_is_a_bridge() -> None:
    """From the middle of its top to that of its bottom it is a long way round the rim."""
    ball = sphere(faces="triangles", frequency=16)
    plate = fanned(ball.moved(ball.points * [1.0, 1.0, 0.02]))
    points = np.array([[0.0, 0.0, 0.02], [0.0, 0.0, -0.02], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    through = PolygonMesh(points, np.array([0, 2, 3, 0, 3, 1, 0, 1, 2, 1, 3, 2]), np.arange(0, 13, 3))
    assert bridges(through, plate, span=0.5).tolist() == [[0, 1]]
    assert len(bridges(through, plate, span=2.0)) == 0


def test_cells_that_follow_the_surface_have_no_bridges(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fabricate.prepare.soundness.SOURCES", 5)
    surface = fanned(sphere(faces="triangles", frequency=16))
    assert len(bridges(sphere(faces="triangles", frequency=2), surface, span=0.1)) == 0
