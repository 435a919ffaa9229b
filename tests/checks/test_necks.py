"""Necks: the narrowest place between two walls of a joint, and only between those."""

from __future__ import annotations

import numpy as np

from fabricate.checks.facts import Narrowest
from fabricate.checks.necks import narrowest_neck
from fabricate.checks.walls import Walls

MEASURED = Walls(
    np.array([0.5, 0.7, 0.9]),
    np.array([[1.0, 0, 0], [2.0, 0, 0], [3.0, 0, 0]]),
    np.ones(3),
    np.array([[0, 1], [1, 2], [2, 3]]),
)


def test_both_ends_belong_to_a_joint() -> None:
    assert narrowest_neck(MEASURED, np.array([False, True, True, True])) == Narrowest(0.7, (2.0, 0.0, 0.0))
    assert narrowest_neck(MEASURED, np.ones(4, dtype=bool)) == Narrowest(0.5, (1.0, 0.0, 0.0))


def test_without_two_such_walls_there_is_none() -> None:
    assert narrowest_neck(MEASURED, np.array([True, False, True, False])) is None
