from __future__ import annotations

import numpy as np
from breaking import box, inside_out, moebius, turned, united, without
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import surfaces

from fabricate.mesh.closed import checked_closed, signed_volume
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.components import split
from fabricate.prepare.orientation import oriented


@given(surfaces(), st.sets(st.integers(0, 100)))
def test_any_flips_are_undone(mesh: PolygonMesh, which: set[int]) -> None:
    found = oriented(turned(mesh, which))
    assert checked_closed(found.mesh) is found.mesh
    assert set(np.flatnonzero(found.flips).tolist()) == which & set(range(len(mesh.offsets) - 1))


@settings(max_examples=30)
@given(st.lists(st.booleans(), min_size=4, max_size=4))
def test_shells_in_shells_turn_together(inward: list[bool]) -> None:
    shells = [inside_out(box(4.0**k)) if turn else box(4.0**k) for k, turn in enumerate(inward)]
    found = [signed_volume(part) > 0 for part in split(oriented(united(*shells)).mesh)]
    assert found == [turn == inward[-1] for turn in inward]


def test_a_body_beside_a_nest_is_judged_by_itself() -> None:
    nest = united(box(4.0), inside_out(box(1.0)), inside_out(box(1.0, at=(9.0, 0.0, 0.0))))
    found = [round(signed_volume(part)) for part in split(oriented(nest).mesh)]
    assert found == [64, -1, 1]


def test_an_open_part_is_wound_consistently_with_fewest_flips() -> None:
    lidless = without(box(), {0})
    assert oriented(lidless).mesh is lidless
    found = oriented(turned(lidless, {2}))
    assert np.flatnonzero(found.flips).tolist() == [2]


def test_one_sided_parts_are_left_alone() -> None:
    strip = moebius()
    assert oriented(strip).mesh is strip


def test_an_open_part_does_not_keep_a_closed_one_from_turning() -> None:
    found = oriented(united(without(box(at=(9.0, 0.0, 0.0)), {0}), inside_out(box())))
    assert found.flips.sum() == 6


def test_no_faces_need_no_flips() -> None:
    nothing = PolygonMesh.from_faces(np.zeros((0, 3)), [])
    assert oriented(nothing).mesh is nothing
