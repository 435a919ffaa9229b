"""Lips: the sides of a groove have the angle that they were given, and one that is steeper in a bend is found."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.solid.lips import lip_steepness

COUNT = 60
ANGLES = 2.0 * np.pi * np.arange(COUNT) / COUNT
CIRCLE = np.stack([np.cos(ANGLES), np.sin(ANGLES), np.zeros(COUNT)], axis=1)
UP = np.tile([0.0, 0.0, 1.0], (COUNT, 1))


def groove(height: np.ndarray) -> np.ndarray:
    """Return the wall round a disc of radius 10, 2 mm deep, with a groove as deep at each point, 1 mm wide."""
    asides = [0.0, 0.0, 1.0, 0.0, 0.0]
    depths = [0.0, 0.5, 1.0, 1.5, 2.0]
    return np.stack(
        [(10.0 + aside * height)[:, None] * CIRCLE - depth * UP for aside, depth in zip(asides, depths, strict=True)]
    )


@pytest.mark.parametrize("degrees", [0.0, 20.0, 45.0, 60.0])
def test_it_is_the_sine_of_the_angle_of_the_sides(degrees: float) -> None:
    walls = groove(np.full(COUNT, 0.5 * np.tan(np.radians(degrees))))
    assert lip_steepness(walls, UP, -UP) == pytest.approx(np.full(COUNT, np.sin(np.radians(degrees))), abs=0.01)


@pytest.mark.parametrize("side", [slice(None, 3), slice(2, None)])
def test_a_steep_place_is_found_on_either_side_and_only_there(side: slice) -> None:
    walls = groove(np.full(COUNT, 0.2))
    steep = groove(np.where(np.arange(COUNT) == 20, 1.0, 0.2))
    walls[side] = steep[side]
    found = lip_steepness(walls, UP, -UP)
    assert np.flatnonzero(found > 0.6).tolist() == [19, 20, 21]
