from __future__ import annotations

import numpy as np
import pytest
from breaking import box, triangles, united, without
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import polyhedra

from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.torus import torus
from fabricate.prepare.capping import lids
from fabricate.prepare.ear_clipping import ear_clipped
from fabricate.prepare.gentle import is_closed_manifold
from fabricate.prepare.wrap import from_triangles


def in_triangles(mesh: PolygonMesh) -> PolygonMesh:
    return from_triangles(mesh.points, ear_clipped(mesh).triangles)


def closed_by(mesh: PolygonMesh) -> PolygonMesh:
    points, covers, _ = lids(mesh)
    return from_triangles(points, np.concatenate([mesh.corners.reshape(-1, 3), covers]))


def test_a_box_without_its_lid_gets_one() -> None:
    lidless = in_triangles(without(box(), {3}))
    found = lids(lidless)
    assert (len(found.triangles), found.number) == (4, 1)
    assert is_closed_manifold(closed_by(lidless))


@given(st.integers(0, 14))
def test_one_lost_face_of_a_torus_is_closed(lost: int) -> None:
    mesh = without(torus(around=5, across=3, tube=0.4), {lost})
    assert is_closed_manifold(closed_by(in_triangles(mesh)))


@given(polyhedra())
def test_closed_surfaces_get_none(mesh: PolygonMesh) -> None:
    found = lids(in_triangles(mesh))
    assert (len(found.triangles), found.number) == (0, 0)


def test_a_sheet_stays_open_and_each_component_is_judged_by_its_own_size() -> None:
    sheet = PolygonMesh.from_faces(np.eye(3), [[0, 1, 2]])
    assert lids(sheet).number == 0
    both = in_triangles(united(box(), sheet, without(box(0.01), {0})))
    assert lids(both).number == 1


@pytest.mark.parametrize("height", [0.2, 1.0, 5.0])
def test_long_tubes_are_closed_and_rings_are_not(height: float) -> None:
    stretched = box().moved(box().points * [1, 1, height])
    caps = {n for n in range(6) if np.ptp(stretched.points[box().corners[4 * n : 4 * n + 4], 2]) == 0}
    tube = from_triangles(stretched.points, triangles(without(stretched, caps)))
    assert lids(tube).number == (2 if height >= 1 else 0)
