"""Necks: the narrowest place between two walls of a joint, and only between those."""

from __future__ import annotations

import numpy as np

from fabricate.checks.contacts import Facing
from fabricate.checks.facts import Narrowest
from fabricate.checks.necks import AT_A_TIME, narrowest_neck
from fabricate.checks.walls import Walls
from fabricate.triangles.search_tree import SearchTree

MEASURED = Walls(
    np.array([0.5, 0.7, 0.9]),
    np.array([[1.0, 0, 0], [2.0, 0, 0], [3.0, 0, 0]]),
    np.ones(3),
    np.array([[0, 1], [1, 2], [2, 3]]),
)


def joint(near: list[bool]) -> Facing:
    """Return the joint of four triangles with a part that those near enough lie on."""
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=float)
    tree = SearchTree.of(points, np.zeros((4, 3), dtype=np.int64) + np.arange(3))
    return Facing(tree, tree, np.array(near), 0.0)


def test_both_ends_belong_to_a_joint() -> None:
    assert narrowest_neck(MEASURED, [joint([False, True, True, True])]) == Narrowest(0.7, (2.0, 0.0, 0.0))
    assert narrowest_neck(MEASURED, [joint([True] * 4)]) == Narrowest(0.5, (1.0, 0.0, 0.0))


def test_the_ends_may_belong_to_joints_with_different_parts() -> None:
    joints = [joint([False, True, False, False]), joint([False, False, True, False])]
    assert narrowest_neck(MEASURED, joints) == Narrowest(0.7, (2.0, 0.0, 0.0))


def test_without_two_such_walls_there_is_none() -> None:
    assert narrowest_neck(MEASURED, [joint([True, False, True, False])]) is None
    assert narrowest_neck(MEASURED, []) is None


def test_walls_count_as_thin_as_they_are_however_many_are_thinner() -> None:
    """Of many thin walls that are near another part without facing it, all are looked at."""
    count = 3 * AT_A_TIME
    faces = np.zeros((count, 2), dtype=np.int64)
    faces[-1] = 1
    walls = Walls(np.linspace(0.1, 1.0, count), np.zeros((count, 3)), np.ones(count), faces)
    own = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 0, 0], [6, 0, 0], [5, 1, 0]], dtype=float)
    other = own[3:] + np.array([0, 0, 0.3])
    part = SearchTree.of(own, np.array([[0, 1, 2], [3, 4, 5]]))
    facing = Facing(part, SearchTree.of(other, np.array([[0, 2, 1]])), np.array([True, True]), 0.3)
    assert narrowest_neck(walls, [facing]) == Narrowest(1.0, (0.0, 0.0, 0.0))
