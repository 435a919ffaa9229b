from __future__ import annotations

from dataclasses import FrozenInstanceError

import numpy as np
import pytest
from creases import creased_surfaces
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import face_lists, surfaces

from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh

MESHES = surfaces()


@st.composite
def face_soups(draw: st.DrawFn) -> list[list[int]]:
    """Draw faces of any sizes, empty ones too; nothing says that they form a surface."""
    return draw(st.lists(st.lists(st.integers(0, 7), max_size=6), max_size=6))


@given(faces=face_soups())
def test_faces_come_back_as_they_went_in(faces: list[list[int]]) -> None:
    mesh = PolygonMesh.from_faces(np.zeros((8, 3)), faces)
    assert face_lists(mesh) == faces
    assert mesh.face_sizes.tolist() == [len(face) for face in faces]


@given(faces=face_soups())
def test_next_corner_walks_round_each_face_and_nowhere_else(faces: list[list[int]]) -> None:
    mesh = PolygonMesh.from_faces(np.zeros((8, 3)), faces)
    following = mesh.next_corner
    assert sorted(following.tolist()) == list(range(len(mesh.corners)))
    assert mesh.face_of_corner[following].tolist() == mesh.face_of_corner.tolist()
    for face, begin in zip(faces, mesh.offsets.tolist(), strict=False):
        walked, corner = [], begin
        for _ in face:
            walked.append(int(mesh.corners[corner]))
            corner = following[corner]
        assert walked == face
        assert corner == begin


@given(mesh=MESHES)
def test_face_of_corner_names_the_face_that_holds_it(mesh: PolygonMesh) -> None:
    for number, (begin, end) in enumerate(zip(mesh.offsets, mesh.offsets[1:], strict=False)):
        assert set(mesh.face_of_corner[begin:end].tolist()) == {number}


@given(mesh=MESHES, factor=st.floats(-100, 100))
def test_scaled_multiplies_points_and_keeps_faces(mesh: PolygonMesh, factor: float) -> None:
    scaled = mesh.scaled(factor)
    np.testing.assert_allclose(scaled.points, mesh.points * factor, rtol=1e-15)
    assert face_lists(scaled) == face_lists(mesh)


@given(mesh=MESHES)
def test_moved_leaves_the_original_alone(mesh: PolygonMesh) -> None:
    before = mesh.points.copy()
    moved = mesh.moved(mesh.points + 1.0)
    assert moved is not mesh
    assert (mesh.points == before).all()
    assert moved.corners is mesh.corners


@given(mesh=MESHES)
def test_without_being_told_no_edge_is_a_crease(mesh: PolygonMesh) -> None:
    assert mesh.creases.shape == mesh.corners.shape
    assert not PolygonMesh(mesh.points, mesh.corners, mesh.offsets).creases.any()


@given(mesh=creased_surfaces(), factor=st.floats(0.1, 10))
def test_creases_stay_when_points_move(mesh: PolygonMesh, factor: float) -> None:
    assert mesh.scaled(factor).creases is mesh.creases
    assert mesh.moved(mesh.points + 1.0).creases is mesh.creases


def test_creases_that_are_not_one_for_each_corner_are_an_error() -> None:
    mesh = cube(divisions=1)
    with pytest.raises(ValueError, match=r"shape \(24\), found \(23,\)"):
        PolygonMesh(mesh.points, mesh.corners, mesh.offsets, np.ones(23, dtype=bool))


@pytest.mark.parametrize("name", ["points", "corners", "offsets", "creases"])
def test_arrays_are_frozen(name: str) -> None:
    mesh = PolygonMesh.from_faces(np.zeros((3, 3)), [[0, 1, 2]])
    with pytest.raises(ValueError, match="read-only"):
        getattr(mesh, name)[0] = 0
    with pytest.raises(FrozenInstanceError):
        setattr(mesh, name, np.zeros(3))


def test_a_mesh_without_faces_is_a_mesh() -> None:
    mesh = PolygonMesh.from_faces(np.zeros((4, 3)), [])
    assert len(mesh.face_sizes) == len(mesh.next_corner) == len(mesh.face_of_corner) == 0


def test_points_in_the_plane_are_an_error() -> None:
    with pytest.raises(ValueError, match=r"shape \(n, 3\), found \(3, 2\)"):
        PolygonMesh.from_faces(np.zeros((3, 2)), [[0, 1, 2]])
