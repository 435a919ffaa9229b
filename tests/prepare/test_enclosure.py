from __future__ import annotations

import numpy as np
import pytest
from breaking import box, moebius, united, without

from fabricate.errors import MeshError
from fabricate.mesh.closed import check_closed_manifold, checked_closed, genus, signed_volume
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.torus import torus
from fabricate.prepare.enclosure import OFFSET, SHEET_OFFSET, enclosed, is_sheet
from fabricate.prepare.repaired import Action

pytest.importorskip("pymeshlab")


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e20])
def test_an_open_box_is_a_box_again_whatever_its_size(scale: float) -> None:
    found = enclosed(without(box(scale), {1}))
    grown = 1 + 2 * OFFSET * np.sqrt(3)
    assert 1 < signed_volume(found.mesh) / scale**3 < grown**3
    assert found.actions == (Action("holes closed by lids", 1), Action("surfaces wrapped", 1))
    assert genus(checked_closed(found.mesh)) == 0


def test_bodies_in_each_other_become_one() -> None:
    both = united(box(), box(at=(0.5, 0.4, 0.3)))
    found = checked_closed(enclosed(both).mesh)
    assert signed_volume(found) == pytest.approx(2 - 0.5 * 0.6 * 0.7, rel=0.05)


def test_a_torus_keeps_its_hole() -> None:
    ring = torus(around=24, across=12, tube=0.4)
    assert genus(checked_closed(enclosed(without(ring, {5})).mesh)) == 1


def test_a_sheet_gets_thickness() -> None:
    square = PolygonMesh.from_faces([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    found = checked_closed(enclosed(square).mesh)
    assert np.ptp(found.points[:, 2]) == pytest.approx(2 * SHEET_OFFSET * np.sqrt(2), rel=0.05)


def test_a_body_with_a_sheet_is_wrapped_as_sheets_are() -> None:
    sail = PolygonMesh.from_faces([[0, 0, 0], [0, 2.5, 0], [0, 2.5, 2], [0, 0, 2]], [[0, 1, 2, 3]])
    found = checked_closed(enclosed(united(box(), sail)).mesh)
    x, y, z = found.points.T
    on_sail = (y > 0.8) & (y < 2.3) & (z > 0.8) & (z < 1.8)
    assert np.ptp(x[on_sail]) == pytest.approx(2 * SHEET_OFFSET * np.linalg.norm([1, 3, 2.5]), rel=0.1)


@pytest.mark.parametrize(("thickness", "sheet"), [(0.004, True), (0.05, False)])
@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_a_closed_plate_is_a_sheet_when_it_is_thin_for_its_size(thickness: float, scale: float, sheet: bool) -> None:
    plate = box().moved(box().points * [scale, scale, thickness * scale])
    assert is_sheet(plate) == sheet


def test_a_moebius_strip_becomes_a_ring() -> None:
    assert genus(checked_closed(enclosed(moebius(24)).mesh)) == 1


def test_points_that_are_no_numbers_do_not_matter() -> None:
    mesh = PolygonMesh.from_faces(
        np.vstack([box().points, [np.nan, 0, 0]]), [*np.reshape(box().corners, (6, 4)).tolist(), [0, 1, 8]]
    )
    check_closed_manifold(enclosed(mesh).mesh)


def test_a_mesh_without_area_is_refused() -> None:
    with pytest.raises(MeshError, match="without area"):
        enclosed(PolygonMesh.from_faces(np.ones((3, 3)), [[0, 1, 2]]))
    with pytest.raises(MeshError, match="no faces with finite corners"):
        enclosed(PolygonMesh.from_faces(np.ones((3, 3)), []))
