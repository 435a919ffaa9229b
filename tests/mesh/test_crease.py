from __future__ import annotations

import os
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from creases import prism, with_random_creases
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import HANDLES, face_lists, octahedron, polyhedra, seeds, surfaces, tetrahedron
from scipy.spatial.transform import Rotation

from fabricate.errors import MeshError
from fabricate.formats.reading import read_mesh
from fabricate.mesh.closed import checked_closed
from fabricate.mesh.crease import corner_angles, creased, dihedral_angles, fanned_corners, polygon_normals
from fabricate.mesh.cube import cube
from fabricate.mesh.half_edges import half_edges
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import dodecahedron


def naive_normal(points: np.ndarray, face: list[int]) -> np.ndarray:
    """Sum the cross products of the edges' ends: Newell's normal, face by face."""
    return np.sum([np.cross(points[a], points[b]) for a, b in pairwise([*face, face[0]])], axis=0)


def wedge(angle: float) -> PolygonMesh:
    """Return a triangular prism one of whose upright edges turns by `angle` degrees."""
    half = np.radians(180.0 - angle) / 2
    triangle = np.array([[0, 0], [np.cos(half), -np.sin(half)], [np.cos(half), np.sin(half)]])
    points = np.concatenate([np.insert(triangle, 2, z, axis=1) for z in (0.0, 1.0)])
    return PolygonMesh.from_faces(points, [[2, 1, 0], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]])


def upright(mesh: PolygonMesh) -> np.ndarray:
    """Return the half-edges between points 0 and 3."""
    return np.asarray(mesh.corners + mesh.corners[mesh.next_corner] == 3) & np.isin(mesh.corners, [0, 3])


@given(mesh=surfaces(), angle=st.floats(0, 180))
def test_creases_are_on_both_half_edges_of_sharp_edges_only(mesh: PolygonMesh, angle: float) -> None:
    found = creased(mesh, angle=angle)
    assert (found.creases == found.creases[half_edges(mesh).twin]).all()
    assert (found.creases == (np.degrees(dihedral_angles(mesh)) >= angle)).mean() > 0.99  # rounding of degrees
    assert found.points is mesh.points
    assert found.corners is mesh.corners


@given(mesh=surfaces())
def test_normals_are_those_of_newell(mesh: PolygonMesh) -> None:
    wanted = [naive_normal(mesh.points, face) for face in face_lists(mesh)]
    np.testing.assert_allclose(polygon_normals(mesh), wanted, atol=1e-12)


@given(mesh=polyhedra(), shift=st.floats(-1e6, 1e6), seed=seeds)
def test_angles_do_not_depend_on_where_the_mesh_stands(mesh: PolygonMesh, shift: float, seed: int) -> None:
    turn = Rotation.random(random_state=np.random.RandomState(seed)).as_matrix()
    moved = mesh.moved(3.7 * mesh.points @ turn + shift)
    np.testing.assert_allclose(dihedral_angles(moved), dihedral_angles(mesh), atol=1e-7)


@given(mesh=surfaces())
def test_at_zero_every_edge_is_a_crease_and_at_most_none_that_is_flat(mesh: PolygonMesh) -> None:
    assert creased(mesh, angle=0.0).creases.all()
    assert not creased(cube(divisions=3), angle=1.0).creases[np.isclose(dihedral_angles(cube(divisions=3)), 0)].any()


@pytest.mark.parametrize(
    ("mesh", "degrees"),
    [
        (cube(divisions=1), 90.0),
        (tetrahedron(), np.degrees(np.arccos(-1 / 3))),
        (octahedron(), np.degrees(np.arccos(1 / 3))),
        (dodecahedron(), np.degrees(np.arccos(1 / np.sqrt(5)))),
    ],
)
def test_angles_of_regular_solids(mesh: PolygonMesh, degrees: float) -> None:
    np.testing.assert_allclose(np.degrees(dihedral_angles(mesh)), degrees, rtol=1e-12)
    assert creased(mesh, angle=degrees - 0.01).creases.all()
    assert not creased(mesh, angle=degrees + 0.01).creases.any()


@pytest.mark.parametrize("divisions", [1, 2, 5])
def test_a_divided_cube_has_creases_on_its_twelve_edges(divisions: int) -> None:
    mesh = creased(cube(divisions=divisions), angle=40.0)
    assert mesh.creases.sum() == 2 * 12 * divisions
    begins, ends = (mesh.points[corners][mesh.creases] for corners in (mesh.corners, mesh.corners[mesh.next_corner]))
    assert (((begins == ends) & (np.abs(begins) == 1.0)).sum(axis=1) == 2).all()


@given(angle=st.floats(1.0, 175.0), step=st.floats(1e-6, 1.0))
def test_an_edge_is_a_crease_from_its_own_angle_on(angle: float, step: float) -> None:
    mesh = wedge(angle)
    np.testing.assert_allclose(np.degrees(dihedral_angles(mesh))[upright(mesh)], angle, rtol=1e-9)
    assert creased(mesh, angle=angle - step).creases[upright(mesh)].all()
    assert not creased(mesh, angle=angle + step).creases[upright(mesh)].any()


def test_creases_that_were_there_are_replaced() -> None:
    mesh = with_random_creases(cube(divisions=2), share=0.5, seed=1)
    assert (creased(mesh, angle=40.0).creases == creased(cube(divisions=2), angle=40.0).creases).all()


@pytest.mark.parametrize("angle", [-1.0, 180.5, float("nan"), float("inf")])
def test_an_angle_that_is_none_is_an_error(angle: float) -> None:
    with pytest.raises(MeshError, match=r"a crease angle lies between 0 and 180 deg, found") as caught:
        creased(cube(divisions=1), angle=angle)
    assert "\n" not in str(caught.value)


@given(mesh=surfaces())
def test_corner_angles_of_flat_faces_add_up(mesh: PolygonMesh) -> None:
    angles = corner_angles(mesh)
    assert ((angles >= 0) & (angles < 2 * np.pi)).all()
    triangles = mesh.face_sizes == 3
    sums = np.add.reduceat(angles, mesh.offsets[:-1])
    np.testing.assert_allclose(sums[triangles], np.pi, rtol=1e-9)


def notched() -> PolygonMesh:
    """Return a block with an L for its floor and its ceiling, the latter with an edge into its notch."""
    outline = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], dtype=float)
    points = np.concatenate([np.insert(outline, 2, z, axis=1) for z in (0.0, 1.0)])
    walls = [[k, (k + 1) % 6, (k + 1) % 6 + 6, k + 6] for k in range(6)]
    return PolygonMesh.from_faces(points, [[5, 4, 3, 2, 1, 0], [6, 7, 8, 9], [6, 9, 10, 11], *walls])


def test_a_concave_corner_of_a_polygon_is_wider_than_straight() -> None:
    mesh = notched()
    floor = np.degrees(corner_angles(mesh)[:6])
    np.testing.assert_allclose(floor, [90, 90, 270, 90, 90, 90], atol=1e-9)


def test_edges_into_a_concave_sector_are_fanned_and_no_others() -> None:
    mesh = creased(notched(), angle=40.0)
    fanned = fanned_corners(mesh)
    added = np.flatnonzero(fanned.creases & ~mesh.creases)
    assert sorted(mesh.corners[added].tolist()) == [6, 9]
    assert (fanned.creases >= mesh.creases).all()


@pytest.mark.parametrize("mesh", [cube(divisions=4), tetrahedron(), prism(7, height=1.0), wedge(50.0)])
def test_where_no_sector_is_concave_nothing_is_fanned(mesh: PolygonMesh) -> None:
    sharp = creased(mesh, angle=40.0)
    assert (fanned_corners(sharp).creases == sharp.creases).all()


@given(mesh=surfaces())
def test_without_corners_nothing_is_fanned(mesh: PolygonMesh) -> None:
    assert not fanned_corners(mesh).creases.any()
    everything = replace(mesh, creases=np.ones(len(mesh.corners), dtype=bool))
    assert fanned_corners(everything).creases.all()


@pytest.mark.parametrize("name", ["double torus", "triple torus", "genus six"])
def test_fanned_creases_are_those_of_both_half_edges(name: str) -> None:
    sharp = creased(HANDLES[name][0], angle=40.0)
    fanned = fanned_corners(sharp)
    assert fanned.creases.sum() > sharp.creases.sum()
    assert (fanned.creases == fanned.creases[half_edges(fanned).twin]).all()
    assert (fanned_corners(fanned).creases == fanned.creases).all()


@pytest.mark.skipif("FABRICATE_CORPUS" not in os.environ, reason="FABRICATE_CORPUS names no folder of meshes")
def test_a_part_from_a_cad_program_is_sharp_at_right_angles_and_chamfers() -> None:
    path = Path(os.environ["FABRICATE_CORPUS"]) / "good" / "box_component_g6.ply"
    mesh = creased(checked_closed(read_mesh(path)), angle=40.0)
    angles = np.degrees(dihedral_angles(mesh))[mesh.creases]
    assert len(angles) > 1000
    assert set((15 * np.round(angles / 15)).tolist()) == {45, 90}
