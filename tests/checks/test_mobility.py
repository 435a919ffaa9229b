"""Mobility: joints whose freedom is known, from parting planes to balls that turn in their shells."""

from __future__ import annotations

import numpy as np
import pytest
from joints import GAP, ball, case, curved_peg, half_balls, part_of, peg_in_hole, peg_with_heads, spacing, turned
from manifold3d import Manifold

from fabricate.checks.contacts import contacts
from fabricate.checks.mobility import Mobility, mobility
from fabricate.solid.part import Part


def judged(first: Part, second: Part) -> Mobility:
    return mobility(contacts(spacing(first, second), clearance=GAP), first.points)


def test_halves_of_a_ball_are_free() -> None:
    first, second = half_balls()
    found = judged(first, second)
    assert not found.caught
    assert found.play.z == np.inf  # up without end, whatever stops it below
    assert not judged(second, first).caught


def test_a_round_peg_slides_and_turns_in_its_hole() -> None:
    found = judged(*peg_in_hole(round_one=True))
    assert not found.caught
    assert found.play.z == np.inf
    assert found.play.x == pytest.approx(GAP, rel=0.02)
    assert found.play.y == pytest.approx(GAP, rel=0.02)
    assert np.isfinite([found.play.rx, found.play.ry]).all()


def test_a_square_peg_slides_along_one_axis_only() -> None:
    found = judged(*peg_in_hole(round_one=False))
    assert [found.play.x, found.play.y] == pytest.approx([GAP, GAP], rel=1e-4)
    assert found.play.z == np.inf
    assert np.isfinite([found.play.rx, found.play.ry, found.play.rz]).all()
    for way in found.ways_out:
        along = way.shift / np.linalg.norm(way.shift)
        assert abs(along[2]) == pytest.approx(1.0, abs=1e-6)
        assert not way.turn.any()


def test_a_slanted_peg_slides_along_its_own_axis() -> None:
    peg, plate = (turned(part, 0.7, (1, 2, 3)) for part in peg_in_hole(round_one=False))
    axis = turned(Part("z", np.array([[0.0, 0, 1]]), np.zeros((0, 3), dtype=int)), 0.7, (1, 2, 3)).points[0]
    found = judged(peg, plate)
    assert found.ways_out
    for way in found.ways_out:
        assert abs(way.shift @ axis) == pytest.approx(float(np.linalg.norm(way.shift)), rel=1e-6)


def test_a_peg_with_heads_is_caught() -> None:
    found = judged(*peg_with_heads())
    assert found.caught
    assert found.play.z == pytest.approx(GAP, rel=1e-3)
    assert found.play.x == pytest.approx(GAP, rel=0.02)


def test_a_box_in_a_box_is_caught_with_the_gap_on_either_side() -> None:
    inner = part_of(Manifold.cube((10, 12, 14), True))
    outer = part_of(Manifold.cube((20, 20, 20), True) - Manifold.cube((10 + 2 * GAP, 12 + 2 * GAP, 14 + 2 * GAP), True))
    found = judged(inner, outer)
    assert found.caught
    assert [found.play.x, found.play.y, found.play.z] == pytest.approx(3 * [GAP], rel=1e-4)
    assert judged(outer, inner).caught


def test_out_of_the_middle_the_farther_stop_counts() -> None:
    inner = part_of(Manifold.cube((10, 10, 10), True).translate((0.1, 0, 0)))
    hole = Manifold.cube(3 * [10 + 2 * GAP], True)
    play = judged(inner, part_of(Manifold.cube((20, 20, 20), True) - hole)).play
    assert [play.x, play.y, play.z] == pytest.approx([GAP + 0.1, GAP, GAP], rel=1e-4)


@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), (8.0, -3.0, 5.0)])
def test_a_ball_in_a_shell_turns_freely_and_is_caught(shift: tuple[float, float, float]) -> None:
    inside, outside = ball(10.0, shift), case(10.0 + GAP, shift=shift)
    for first, second in ((inside, outside), (outside, inside)):
        found = judged(first, second)
        assert found.caught
        assert [found.play.x, found.play.y, found.play.z] == pytest.approx(3 * [GAP], rel=0.03)
        assert min(found.play.rx, found.play.ry, found.play.rz) > 2.5  # until facets catch in each other


def test_a_curved_peg_has_a_way_out_that_turns() -> None:
    found = judged(*curved_peg())
    assert any(np.linalg.norm(way.turn) > 0.1 for way in found.ways_out)


def test_parts_far_from_each_other_are_free() -> None:
    assert not judged(ball(5.0), ball(5.0, (30.0, 0.0, 0.0))).caught
