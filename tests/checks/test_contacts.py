"""Contacts: walls that face each other, and the point that stays when a part turns."""

from __future__ import annotations

import numpy as np
import pytest
from joints import GAP, ball, case, half_balls, part_of, spacing
from manifold3d import Manifold

from fabricate.arrays import Floats
from fabricate.checks.contacts import Facing, contacts, joint_pivot, shared_area
from fabricate.checks.geometry import triangle_areas


def test_contacts_face_each_other_at_the_clearance() -> None:
    met = contacts(spacing(ball(10.0), case(10.0 + GAP)), clearance=GAP)
    assert len(met.gaps) > 1000
    assert met.gaps == pytest.approx(GAP, rel=0.01)
    outward = np.einsum("ij,ij->i", met.points, met.normals)
    assert (outward > 0.95 * np.linalg.norm(met.points, axis=1)).all()


def test_the_pivot_of_a_ball_is_its_centre() -> None:
    centre = np.array([8.0, -3.0, 5.0])
    inside, outside = ball(10.0, (8.0, -3.0, 5.0)), case(10.0 + GAP, shift=(8.0, -3.0, 5.0))
    met = contacts(spacing(outside, inside), clearance=GAP)
    assert np.linalg.norm(joint_pivot(met, np.zeros(3)) - centre) < 1e-3


def test_the_pivot_of_planes_stays_as_high_as_the_centroid() -> None:
    met = contacts(spacing(*half_balls()), clearance=GAP)
    centroid: Floats = np.array([1.0, 2.0, 9.0])
    assert joint_pivot(met, centroid) == pytest.approx([*met.points[:, :2].mean(axis=0), 9.0])


def test_without_contacts_the_pivot_is_the_centroid() -> None:
    met = contacts(spacing(ball(5.0), ball(5.0, (30.0, 0.0, 0.0))), clearance=GAP)
    assert len(met.gaps) == 0
    assert joint_pivot(met, np.ones(3)).tolist() == [1, 1, 1]


def test_triangles_that_face_the_other_part_are_those_of_the_joint() -> None:
    inside, outside = ball(10.0), case(10.0 + GAP)
    measured = spacing(inside, outside)
    one = Facing.between(measured.first, measured.second, measured.to_second, clearance=GAP)
    other = Facing.between(measured.second, measured.first, measured.to_first, clearance=GAP)
    assert one.among(np.arange(len(inside.triangles))).all()
    assert other.among(np.arange(len(outside.triangles))).tolist() == [False] * 12 + [True] * len(inside.triangles)


def test_without_clearance_the_shared_faces_are_the_joint() -> None:
    outside = case(10.0)
    measured = spacing(ball(10.0), outside)
    other = Facing.between(measured.second, measured.first, measured.to_first, clearance=0.0)
    facing = other.among(np.arange(len(outside.triangles)))
    assert facing.tolist() == [False] * 12 + [True] * (len(facing) - 12)


@pytest.mark.parametrize(("gap", "share"), [(0.0, 1.0), (0.01, 0.0), (-0.01, 0.0)])
def test_shared_faces_have_the_area_of_what_coincides(gap: float, share: float) -> None:
    inside = ball(10.0)
    found = shared_area(spacing(inside, case(10.0 + gap)))
    assert found == pytest.approx(share * triangle_areas(inside).sum(), rel=1e-6)


def test_faces_are_shared_as_far_as_they_cover_each_other() -> None:
    plate = part_of(Manifold.cube((30, 30, 8)).refine(15))
    cube = part_of(Manifold.cube((6, 6, 6)).translate((7, 9, 8)))
    assert shared_area(spacing(plate, cube)) == pytest.approx(36.0, rel=0.2)
    assert shared_area(spacing(cube, plate)) == pytest.approx(36.0)
