"""Duplicate faces: surfaces said twice keep one copy, surfaces folded onto themselves vanish."""

from __future__ import annotations

import numpy as np
import pytest
from breaking import box, with_faces, without
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import face_lists, octahedron, surfaces, tetrahedron

from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.duplicates import copy_groups, superfluous


def left(mesh: PolygonMesh) -> list[int]:
    return np.flatnonzero(~superfluous(mesh)).tolist()


@given(surfaces(), st.sets(st.integers(0, 50)), st.integers(0, 5), st.booleans())
def test_copies_of_faces_of_a_closed_surface_go(mesh: PolygonMesh, which: set[int], turn: int, back: bool) -> None:
    faces = face_lists(mesh)
    copies = [face[turn % len(face) :] + face[: turn % len(face)] for n, face in enumerate(faces) if n in which]
    doubled = with_faces(mesh, faces + [copy[::-1] if back else copy for copy in copies])
    assert left(doubled) == list(range(len(faces)))
    groups = copy_groups(doubled)
    assert len(np.unique(groups)) == len(faces)
    assert groups[len(faces) :].tolist() == [groups[n] for n in sorted(which) if n < len(faces)]


@pytest.mark.parametrize("times", [2, 3, 4])
def test_of_a_whole_mesh_said_several_times_one_stays(times: int) -> None:
    for mesh in (octahedron(), without(octahedron(), {0, 3}), with_faces(octahedron(), [[0, 2, 4]])):
        count = len(mesh.offsets) - 1
        assert left(with_faces(mesh, times * face_lists(mesh))) == list(range(count))


@pytest.mark.parametrize("fins", [[[0, 1, 4]], [[0, 1, 4], [0, 4, 5]], [[0, 1, 4], [0, 4, 5], [4, 1, 6]]])
def test_a_fin_without_thickness_vanishes(fins: list[list[int]]) -> None:
    mesh = tetrahedron()
    points = np.concatenate([mesh.points, np.random.default_rng(0).random((3, 3)) + 2])
    both_sides = [face[::step] for face in fins for step in (1, -1)]
    assert left(PolygonMesh.from_faces(points, both_sides + face_lists(mesh))) == list(
        range(len(both_sides), len(both_sides) + 4)
    )


def test_other_cycles_through_the_same_corners_are_no_copies() -> None:
    faces = face_lists(box())
    crossed = [faces[0][0], faces[0][2], faces[0][1], faces[0][3]]
    assert not superfluous(with_faces(box(), [*faces, crossed])).any()


def test_a_mesh_without_copies_keeps_all() -> None:
    assert not superfluous(box()).any()
