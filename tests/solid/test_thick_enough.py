"""Bodies thinner than the gap are refused, and how thick one is does not depend on how finely it is divided."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.errors import SolidError
from fabricate.mesh.cube import cube
from fabricate.prepare.triangle_mesh import TriangleMesh, fanned
from fabricate.solid.thick_enough import check_thick


def plate(thickness: float) -> TriangleMesh:
    """Return a square plate of 40 mm."""
    mesh = cube(divisions=4)
    side = np.ptp(mesh.points[:, 0])
    return fanned(mesh.moved(mesh.points * np.array([40.0, 40.0, thickness]) / side))


def test_a_plate_is_as_thick_as_it_is() -> None:
    sheet = plate(0.5)
    check_thick(sheet.points, sheet.triangles, clearance=0.49)
    with pytest.raises(SolidError, match=r"no more than 0\.5 mm thick, and the clearance is 0\.51 mm") as caught:
        check_thick(sheet.points, sheet.triangles, clearance=0.51)
    assert "\n" not in str(caught.value)


def test_a_thick_body_with_many_small_faces_on_a_thin_fin_is_thick() -> None:
    block, fin = plate(20.0), fanned(cube(divisions=12))
    fin_points = fin.points / np.ptp(fin.points[:, 0]) * [10.0, 10.0, 0.1] + [0.0, 0.0, 50.0]
    points = np.concatenate([block.points, fin_points])
    triangles = np.concatenate([block.triangles, fin.triangles + len(block.points)])
    assert len(fin.triangles) > len(block.triangles)
    check_thick(points, triangles, clearance=0.4)
