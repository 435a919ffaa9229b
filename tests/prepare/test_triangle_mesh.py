"""Triangle meshes: edges, fans and decimation keep every closed mesh closed, with its genus and its volume."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from polyhedra import HANDLES, surfaces, tetrahedron

from fabricate.mesh.closed import checked_closed, genus, signed_volume
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.triangle_mesh import adjacency, decimated, edges, fanned


@given(surfaces())
def test_fans_keep_genus_and_volume(mesh: PolygonMesh) -> None:
    made = checked_closed(fanned(mesh).polygons)
    assert genus(made) == genus(mesh)
    assert signed_volume(made) == pytest.approx(signed_volume(mesh))


@given(surfaces())
def test_every_edge_has_two_triangles_that_run_opposite_ways(mesh: PolygonMesh) -> None:
    triangles = fanned(mesh)
    joined = edges(triangles)
    assert 2 * len(joined.ends) == 3 * len(triangles.triangles)
    tail, head = triangles.triangles.ravel(), np.roll(triangles.triangles, -1, axis=1).ravel()
    assert (np.stack([tail, head], axis=1)[joined.sides[:, 0]] == joined.ends).all()
    assert (np.stack([head, tail], axis=1)[joined.sides[:, 1]] == joined.ends).all()
    for k in range(2):
        corners = np.column_stack([joined.ends, joined.opposite[:, k]])
        assert (np.sort(triangles.triangles[joined.triangles[:, k]], axis=1) == np.sort(corners, axis=1)).all()
    assert (np.bincount(joined.of_triangle.ravel()) == 2).all()


def test_area_and_valence_of_a_cube() -> None:
    fans = fanned(cube(divisions=1))
    side = float(np.ptp(cube(divisions=1).points[:, 0]))
    assert fans.area == pytest.approx(6 * side**2)
    assert np.bincount(fans.valence).tolist() == [0, 0, 0, 0, 6, 0, 8]  # face centres, corners


def test_points_of_a_tetrahedron_are_all_joined() -> None:
    mesh = fanned(tetrahedron())
    assert (adjacency(mesh, edges(mesh)).toarray() == 1 - np.eye(4)).all()


@pytest.mark.parametrize("name", HANDLES)
def test_decimation_keeps_handles(name: str) -> None:
    mesh, handles = HANDLES[name]
    made = decimated(fanned(mesh), triangles=40)
    assert len(made.triangles) < len(fanned(mesh).triangles)
    assert genus(checked_closed(made.polygons)) == handles


def test_few_triangles_stay_as_they_are() -> None:
    mesh = fanned(cube(divisions=2))
    assert decimated(mesh, triangles=len(mesh.triangles)) is mesh
