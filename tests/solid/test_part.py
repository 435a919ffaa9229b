"""A part: float32-exact coordinates that nobody can change."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.solid.part import Part

TRIANGLE = np.array([[0, 1, 2]])


def test_coordinates_are_those_of_an_stl() -> None:
    part = Part("yellow", np.array([[0.1, 0.2, 0.3], [1 / 3, -0.0, 1e3], [0, 1, 0]]), TRIANGLE)
    assert part.points.dtype == np.float64
    assert (part.points == part.points.astype(np.float32)).all()
    assert part.points == pytest.approx(np.array([[0.1, 0.2, 0.3], [1 / 3, 0, 1e3], [0, 1, 0]]), rel=1e-7)


def test_there_is_no_negative_zero() -> None:
    part = Part("yellow", np.full((3, 3), -0.0), TRIANGLE)
    assert not np.signbit(part.points).any()


def test_it_is_frozen_and_what_it_was_made_of_is_not() -> None:
    points = np.eye(3)
    part = Part("yellow", points, TRIANGLE)
    with pytest.raises(ValueError, match="read-only"):
        part.points[0, 0] = 2.0
    with pytest.raises(ValueError, match="read-only"):
        part.triangles[0, 0] = 2
    points[0, 0] = 5.0
    assert part.points[0, 0] == 1.0


@pytest.mark.parametrize(("points", "triangles"), [((3, 2), (1, 3)), ((3, 3), (1, 4)), ((9,), (1, 3))])
def test_other_shapes_are_refused(points: tuple[int, ...], triangles: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match="shape"):
        Part("yellow", np.zeros(points), np.zeros(triangles, dtype=np.int64))
