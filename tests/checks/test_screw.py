"""Screws: straight ways, turns round an axis, and both at once."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fabricate.arrays import Floats
from fabricate.checks.screw import Screw

ORIGIN = np.zeros(3)


def moved(screw: Screw, point: Floats, time: float) -> Floats:
    place: Floats = screw.after(time) @ np.append(point, 1.0)
    return place


def test_a_straight_way_goes_on_at_one_speed() -> None:
    way = Screw(np.array([1.0, 2, 3]), np.array([0.0, 0, 5]), ORIGIN)
    assert moved(way, np.array([7.0, 8, 9]), 3.0) == pytest.approx([7, 8, 24])
    assert way.speed(100.0) == 5.0


def test_a_turn_leaves_its_pivot_and_keeps_lengths() -> None:
    pivot, turn = np.array([1.0, -2, 4]), np.array([0.3, 0.2, -0.9])
    way = Screw(pivot, ORIGIN, turn)
    assert moved(way, pivot, 2.0) == pytest.approx(pivot)
    point = np.array([5.0, 5, 5])
    assert moved(way, point, 2.0) == pytest.approx(Rotation.from_rotvec(2 * turn).apply(point - pivot) + pivot)


def test_a_shift_across_the_axis_moves_the_axis_aside() -> None:
    # The pivot itself is carried round the axis through (0, 20, 0) to the left of its way.
    way = Screw(ORIGIN, np.array([20.0, 0, 0]), np.array([0.0, 0, 1]))
    assert moved(way, np.array([0.0, 20, 0]), 1.2) == pytest.approx([0, 20, 0])
    assert moved(way, ORIGIN, np.pi) == pytest.approx([0, 40, 0])
