from __future__ import annotations

import numpy as np
import pytest
from breaking import box, triangles
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import tetrahedron

from fabricate.prepare.thinnest import thicknesses, thinnest_place


@given(st.floats(-6, 6), st.floats(0.01, 0.9), st.integers(0, 2))
def test_a_plate_is_as_thin_as_it_is(size: float, thin: float, axis: int) -> None:
    scale = 10.0**size
    stretch = np.ones(3)
    stretch[axis] = thin
    mesh = box(scale, at=(scale, 2 * scale, 0.0))
    points = mesh.points * stretch
    found = thinnest_place(points, triangles(mesh))
    assert found is not None
    assert found.thickness == pytest.approx(thin * scale, rel=1e-3)
    assert min(abs(found.place[axis] - points[:, axis])) < 1e-9 * scale


def test_a_tetrahedron_has_no_opposite_faces() -> None:
    assert thinnest_place(tetrahedron().points, triangles(tetrahedron())) is None


def test_every_triangle_of_a_plate_knows_its_thickness() -> None:
    plate = box().moved(box().points * [4.0, 3.0, 0.5])
    found = thicknesses(plate.points, triangles(plate))
    assert np.sort(found) == pytest.approx(np.sort([0.5, 3.0, 4.0] * 4), rel=1e-4)


def test_triangles_without_area_send_no_ray() -> None:
    assert thinnest_place(np.eye(3), np.array([[0, 0, 1]])) is None
