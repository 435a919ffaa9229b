"""Parting: solids that come out, and solids that would if nobody looked on the way."""

from __future__ import annotations

import numpy as np
from joints import GAP, arc
from manifold3d import Manifold

from fabricate.checks.parting import comes_out
from fabricate.checks.screw import Screw

UP = Screw(np.zeros(3), np.array([0.0, 0, 10]), np.zeros(3))
PEG = Manifold.cylinder(20, 5, 5, 64, True)
PLATE = Manifold.cube((30, 30, 8), True) - Manifold.cylinder(40, 5 + GAP, 5 + GAP, 64, True)


def out(moving: Manifold, other: Manifold, way: Screw) -> bool:
    return comes_out(moving, other, way, clearance=GAP, radius=12.0)


def test_a_peg_comes_out_along_its_axis_only() -> None:
    aside = Screw(np.zeros(3), np.array([10.0, 0, 0]), np.zeros(3))
    assert out(PEG, PLATE, UP)
    assert out(PLATE, PEG, UP)
    assert not out(PEG, PLATE, aside)


def test_a_lid_on_the_way_is_noticed() -> None:
    lid = Manifold.cube((30, 30, 1), True).translate((0, 0, 16))
    assert not out(PEG, PLATE + lid + Manifold.cube((2, 30, 30), True).translate((14, 0, 4)), UP)


def test_a_turn_that_never_leaves_is_no_way_out() -> None:
    ball, hollow = Manifold.sphere(5, 12), Manifold.cube((20, 20, 20), True) - Manifold.sphere(5 + GAP, 12)
    assert not out(ball, hollow, Screw(np.zeros(3), np.zeros(3), np.array([0.0, 0, 1])))


def test_a_bent_peg_turns_out() -> None:
    block = Manifold.cube((16, 24, 12)).translate((10, 2, -6)) - arc(3 + GAP, 90).rotate((0, 0, -20))
    peg = arc(3, 60).rotate((0, 0, -10))
    assert out(peg, block, Screw(np.zeros(3), np.zeros(3), np.array([0.0, 0, 1])))
    assert not out(peg, block, Screw(np.zeros(3), np.array([0.0, 10, 0]), np.zeros(3)))
