"""Pictures fall on places the right way up, in the middle, and not distorted."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.design.projected_image import projected

RAMP_RIGHT = np.tile(np.linspace(0.0, 1.0, 11), (11, 1))
RAMP_UP = RAMP_RIGHT.T[::-1]
CORNERS = np.array([[x, y, z] for x in (-5.0, 5.0) for y in (-5.0, 5.0) for z in (-5.0, 5.0)])


@pytest.mark.parametrize(
    ("axis", "right", "up"),
    [
        ((0, -1, 0), (1, 0, 0), (0, 0, 1)),
        ((0, 2, 0), (-1, 0, 0), (0, 0, 1)),
        ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
        ((0, 0, 1), (1, 0, 0), (0, 1, 0)),
        ((0, 0, -3), (-1, 0, 0), (0, 1, 0)),
    ],
)
def test_right_and_up_are_those_of_the_eye(
    axis: tuple[float, ...], right: tuple[float, ...], up: tuple[float, ...]
) -> None:
    for picture, growing in ((RAMP_RIGHT, right), (RAMP_UP, up)):
        found = projected(picture, CORNERS, axis=np.array(axis))
        side = CORNERS @ np.array(growing)
        assert (found[side > 0] == 1.0).all()
        assert (found[side < 0] == 0.0).all()


def test_the_back_shows_what_the_front_shows() -> None:
    noise = np.random.default_rng(0).random((7, 7))
    front = projected(noise, CORNERS, axis=np.array([0.0, -1.0, 0.0]))
    assert (front == projected(noise, CORNERS * [1, -1, 1], axis=np.array([0.0, -1.0, 0.0]))).all()


def test_a_picture_covers_all_and_keeps_its_shape() -> None:
    wide = np.zeros((10, 30))
    wide[:, :10], wide[:, 20:] = 1.0, 1.0  # the outer thirds, which do not fall on a square
    found = projected(wide, CORNERS, axis=np.array([0.0, -1.0, 0.0]))
    assert found == pytest.approx(0.5, abs=0.5)
    middle = np.concatenate([CORNERS, [[0.0, 0.0, 0.0], [3.0, 0.0, -3.0]]])
    assert projected(wide, middle, axis=np.array([0.0, -1.0, 0.0]))[-2:].tolist() == [0.0, 0.0]


def test_between_pixels_it_is_linear() -> None:
    steps = np.array([[0.0, 1.0]])
    line = np.array([[-1.0, 0.0, 0.0], [-0.5, 0.0, 0.0], [0.0, 0.0, 0.0], [0.25, 0.0, 0.0], [1.0, 0.0, 0.0]])
    assert projected(steps, line, axis=np.array([0.0, -1.0, 0.0])) == pytest.approx([0.0, 0.0, 0.5, 0.75, 1.0])
