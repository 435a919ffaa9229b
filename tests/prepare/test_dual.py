"""The dual: points and faces change places, and everything else stays."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from polyhedra import beads, face_lists, octahedron, surfaces
from polyhedra import dual as dual_by_walking

from fabricate.errors import MeshError
from fabricate.mesh.closed import checked_closed, genus, signed_volume
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.prepare.dual import dual
from fabricate.prepare.triangle_mesh import edges, fanned


def triangles_of(mesh: PolygonMesh) -> PolygonMesh:
    return fanned(mesh).polygons


@given(surfaces())
def test_points_and_faces_change_places(mesh: PolygonMesh) -> None:
    given_mesh = triangles_of(mesh)
    valence = fanned(mesh).valence
    if valence.min() < 3:
        return
    made = dual(given_mesh)
    assert len(made.points) == len(given_mesh.offsets) - 1
    assert made.face_sizes.tolist() == valence.tolist()
    assert (made.points == given_mesh.points[given_mesh.corners.reshape(-1, 3)].mean(axis=1)).all()
    assert genus(made) == genus(mesh)
    corners = given_mesh.corners.reshape(-1, 3)
    for point, face in enumerate(face_lists(made)):
        assert all(point in corners[triangle] for triangle in face)


@given(surfaces())
def test_edges_of_the_dual_cross_those_of_the_triangles(mesh: PolygonMesh) -> None:
    given_mesh = fanned(mesh)
    if given_mesh.valence.min() < 3:
        return
    made = dual(given_mesh.polygons)
    steps = np.sort(np.stack([made.corners, made.corners[made.next_corner]], axis=1), axis=1)
    across = np.sort(edges(given_mesh).triangles, axis=1)
    assert sorted(map(tuple, np.repeat(across, 2, axis=0).tolist())) == sorted(map(tuple, steps.tolist()))


def test_faces_are_those_found_by_walking_round_each_point() -> None:
    mesh = sphere(faces="triangles", frequency=3)
    for ours, walked in zip(face_lists(dual(mesh)), face_lists(dual_by_walking(mesh)), strict=True):
        turn = walked.index(ours[0])
        assert ours == walked[turn:] + walked[:turn]


def test_the_dual_of_an_octahedron_is_a_cube() -> None:
    made = checked_closed(dual(octahedron()))
    assert made.face_sizes.tolist() == [4] * 6
    assert np.abs(made.points) == pytest.approx(1 / 3)
    assert signed_volume(made) == pytest.approx((2 / 3) ** 3)


def test_a_ball_gets_twelve_pentagons_and_hexagons() -> None:
    sizes = dual(sphere(faces="triangles", frequency=5)).face_sizes
    assert np.bincount(sizes).tolist() == [0, 0, 0, 0, 0, 12, len(sizes) - 12]


def test_inside_out_stays_inside_out() -> None:
    mesh = octahedron()
    reverse = PolygonMesh.from_faces(mesh.points, [face[::-1] for face in face_lists(mesh)])
    assert signed_volume(dual(reverse)) < 0 < signed_volume(dual(mesh))


def test_quads_have_no_such_dual() -> None:
    with pytest.raises(MeshError, match="found 4 corners in face 0"):
        dual(cube(divisions=1))


def test_points_of_two_triangles_have_no_face() -> None:
    mesh = triangles_of(beads(3))
    faces = [[0, 1, 2], [0, 2, 1]]
    with pytest.raises(MeshError, match="three triangles at every point, found 2"):
        dual(PolygonMesh.from_faces(mesh.points[:3], faces))
