"""Turns: bars pass where a part stays sound as its file holds it, and faults of every kind are seen."""

from __future__ import annotations

import numpy as np
import pytest
from manifold3d import Manifold

from fabricate.errors import SolidError
from fabricate.solid.booleans import part_of
from fabricate.solid.part import Part
from fabricate.solid.sound_turn import TURNS, is_sound, soundly_turned

CUBE = part_of("yellow", Manifold.cube((10.0, 10.0, 10.0)))


def sliver() -> Manifold:
    """A step so small that float32 has no room for it: two of its corners fall together."""
    return Manifold.cube((10.0, 10.0, 10.0)) + Manifold.cube((5.0, 5.0, 10.0 + 1e-8))


def test_a_cube_is_sound() -> None:
    assert is_sound(CUBE)


def test_nothing_is_not_sound() -> None:
    assert not is_sound(Part("yellow", np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)))


def test_points_that_fall_together_in_a_file_are_seen() -> None:
    assert not is_sound(part_of("yellow", sliver()))
    two = Manifold.cube((1.0, 1.0, 1.0)) + Manifold.cube((1.0, 1.0, 1.0)).translate((1.0, 1.0, 1.0))
    assert not is_sound(part_of("yellow", two))  # two cubes that touch at a corner


def test_a_triangle_without_area_is_seen() -> None:
    """A corner of one triangle moved onto the middle of the opposite edge."""
    first, second = CUBE.triangles[0, :2]
    points = np.concatenate([CUBE.points, [0.5 * (CUBE.points[first] + CUBE.points[second])]])
    beside = next(k for k, triangle in enumerate(CUBE.triangles) if k and {first, second} <= set(triangle.tolist()))
    (far,) = set(CUBE.triangles[beside].tolist()) - {int(first), int(second)}
    split = [[first, len(CUBE.points), second], [second, far, len(CUBE.points)], [len(CUBE.points), far, first]]
    kept = np.delete(CUBE.triangles, beside, axis=0)
    flat = Part("yellow", points, np.concatenate([kept, split]))
    assert not is_sound(flat)


def test_an_open_edge_and_a_turned_triangle_are_seen() -> None:
    assert not is_sound(Part("yellow", CUBE.points, CUBE.triangles[1:]))
    turned = CUBE.triangles.copy()
    turned[0] = turned[0, ::-1]
    assert not is_sound(Part("yellow", CUBE.points, turned))


def test_crossing_triangles_are_seen() -> None:
    """A corner pulled along the cube's diagonal and out through the opposite corner."""
    inside = CUBE.points.copy()
    inside[0] = 10.0 - CUBE.points[0] + np.where(CUBE.points[0] == 0.0, 2.0, -2.0)
    assert not is_sound(Part("yellow", inside, CUBE.triangles))


def test_the_first_turn_that_leaves_the_part_sound_is_taken() -> None:
    found = soundly_turned(CUBE, lambda solid, turn: sliver() if turn < TURNS[2] else solid, advice="")
    assert found.turn == TURNS[2]
    assert is_sound(found.part)


def test_without_any_sound_turn_there_is_advice() -> None:
    with pytest.raises(SolidError, match=r"yellow .* once coordinates are rounded.*; ask for more$") as caught:
        soundly_turned(CUBE, lambda _solid, _turn: sliver(), advice="ask for more")
    assert "\n" not in str(caught.value)


def test_a_part_that_has_faults_before_is_left_to_the_checks() -> None:
    crossed = Manifold.cube((10.0, 10.0, 10.0)) + Manifold.cube((10.0, 10.0, 10.0)).translate((10.0, 10.0, 10.0))
    found = soundly_turned(part_of("yellow", crossed), lambda solid, _turn: solid, advice="")
    assert found.turn == TURNS[0]
