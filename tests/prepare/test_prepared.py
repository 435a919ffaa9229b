"""The stage prepare: bodies that are closed, with what was done to them."""

from __future__ import annotations

import pytest
from test_inspection import RING, twice, with_first_face_flipped, without_first_face

from fabricate.errors import MeshError
from fabricate.mesh.closed import checked_closed, genus, signed_volume
from fabricate.mesh.cube import cube
from fabricate.prepare.prepared import prepared


def test_a_sound_mesh_comes_back_as_it_is() -> None:
    (body,) = prepared(RING, repair="none", components="only", crease=None)
    assert body.mesh is RING
    assert (body.actions, body.notes, body.wrapped) == ((), (), False)


def test_a_flipped_face_is_turned_and_counted() -> None:
    (body,) = prepared(with_first_face_flipped(RING), repair="gentle", components="only", crease=None)
    assert checked_closed(body.mesh) is body.mesh
    assert signed_volume(body.mesh) == pytest.approx(signed_volume(RING))
    assert [action.count for action in body.actions] == [1]


def test_a_hole_needs_a_wrap() -> None:
    with pytest.raises(MeshError, match=r'prepare\.repair = "wrap" would cure it'):
        prepared(without_first_face(RING), repair="gentle", components="only", crease=None)


@pytest.mark.slow
def test_a_wrap_closes_it_and_says_so() -> None:
    (body,) = prepared(without_first_face(RING), repair="wrap", components="only", crease=None)
    assert genus(checked_closed(body.mesh)) == 1
    assert signed_volume(body.mesh) == pytest.approx(signed_volume(RING), rel=0.1)
    assert any("new skin" in note for note in body.notes)
    assert body.wrapped


@pytest.mark.parametrize(("policy", "count"), [("largest", 1), ("each", 2)])
def test_bodies_are_made_as_asked(policy: str, count: int) -> None:
    bodies = prepared(twice(cube(divisions=2)), repair="gentle", components=policy, crease=None)  # type: ignore[arg-type]
    assert len(bodies) == count


def test_only_one_body_is_made_unless_asked() -> None:
    with pytest.raises(MeshError, match="found 2 bodies"):
        prepared(twice(cube(divisions=2)), repair="gentle", components="only", crease=None)


def test_sharp_edges_are_marked() -> None:
    (body,) = prepared(cube(divisions=3), repair="gentle", components="only", crease=40.0)
    assert body.mesh.creases.sum() == 2 * 12 * 3
    (smooth,) = prepared(cube(divisions=3), repair="gentle", components="only", crease=None)
    assert not smooth.mesh.creases.any()
