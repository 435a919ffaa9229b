"""Inscribed balls: between plates, in cylinders and in corners, where their size is known."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from fabricate.arrays import Floats
from fabricate.triangles.inscribed_balls import Balls, inscribed_balls
from fabricate.triangles.search_tree import SearchTree

DOWN = np.array([0.0, 0, -1])


def in_box(sides: tuple[float, float, float], place: Floats, *, largest: float = 100.0) -> Balls:
    """Return the ball in a box round the origin, behind a place on its bottom."""
    box = trimesh.creation.box(sides)
    tree = SearchTree.of(np.array(box.vertices, dtype=float), np.array(box.faces, dtype=np.int64))
    return inscribed_balls(tree, place[None], DOWN[None], largest=np.array([largest]))


@given(st.floats(0.5, 9.0), st.floats(-4.0, 4.0), st.floats(-4.0, 4.0))
def test_a_ball_in_a_box_is_stopped_by_the_lid_or_by_a_side(height: float, x: float, y: float) -> None:
    found = in_box((10, 10, height), np.array([x, y, -height / 2]))
    expected = min(height / 2, 5 - abs(x), 5 - abs(y))
    assert found.radius[0] == pytest.approx(expected, rel=5e-3)
    assert found.triangle[0] >= 0


def test_no_ball_is_larger_than_the_first_one() -> None:
    found = in_box((10, 10, 10), np.array([0.3, 0.2, -5.0]), largest=2.0)
    assert (found.radius[0], found.triangle[0]) == (2.0, -1)
    assert found.point[0].tolist() == [0.3, 0.2, -5.0]


def test_the_place_that_stops_a_ball_is_on_it() -> None:
    place = np.array([1.0, 0.5, -2.0])
    found = in_box((10, 10, 4), place)
    centre = place - found.radius[0] * DOWN
    assert np.linalg.norm(found.point[0] - centre) == pytest.approx(found.radius[0], rel=1e-2)
    assert found.point[0] == pytest.approx([1.0, 0.5, 2.0], abs=0.01)
