"""Facing walls: distances between prisms, cones and walls that come near each other at one place, and their middles."""

from __future__ import annotations

import igl
import numpy as np
import pytest
import trimesh

from fabricate.arrays import Floats
from fabricate.solid.facing import WallGaps, mid_lines, middle_gaps
from fabricate.solid.layers import wall

SIDES = 24
TURN = np.arange(SIDES) * (2 * np.pi / SIDES)
RING = np.stack([np.cos(TURN), np.sin(TURN), np.zeros(SIDES)], axis=1)
CURVE = np.arange(SIDES)
DOWN = np.array([0.0, 0.0, 2.0])


def wall_gaps(left: list[Floats], right: list[Floats]) -> Floats:
    return WallGaps.of(left, right).gaps


def prisms(*, inner: float, outer: float) -> tuple[list[Floats], list[Floats]]:
    return [inner * RING, inner * RING - DOWN], [outer * RING, outer * RING - DOWN]


def test_prisms_are_as_far_apart_as_their_sides() -> None:
    gaps = wall_gaps(*prisms(inner=10.0, outer=10.3))
    assert gaps == pytest.approx(np.full(SIDES, 0.3 * np.cos(np.pi / SIDES)), rel=1e-9)


def test_leaning_walls_are_nearer_than_their_edges() -> None:
    gaps = wall_gaps([10.0 * RING, 12.0 * RING - DOWN], [10.3 * RING, 12.3 * RING - DOWN])
    assert gaps.max() < 0.3 * np.cos(np.pi / 4) + 0.01
    assert gaps.min() > 0.3 * np.cos(np.pi / 4) - 0.01


def test_a_near_place_is_found_where_it_is() -> None:
    yellow, blue = prisms(inner=10.0, outer=11.0)
    yellow[1][5] += 0.8 * RING[5]
    gaps = wall_gaps(yellow, blue)
    assert gaps.argmin() in (4, 5, 6)
    assert gaps[15] == pytest.approx(np.cos(np.pi / SIDES))


def test_a_wall_that_goes_on_under_the_other_is_measured_too() -> None:
    yellow, blue = prisms(inner=10.0, outer=11.0)
    under = 10.2 * RING - 1.1 * DOWN
    assert wall_gaps(yellow, [*blue, under]).max() < 0.3
    assert wall_gaps(yellow, blue).min() > 0.9


def test_no_gap_is_smaller_than_between_dense_samples() -> None:
    random = np.random.default_rng(2)
    noisy = [radius * RING + random.normal(scale=0.05, size=RING.shape) for radius in (10.0, 10.6, 10.0, 10.6)]
    yellow, blue = [noisy[0], noisy[2] - DOWN], [noisy[1], noisy[3] - DOWN]
    gaps = wall_gaps(yellow, blue)
    cells = wall(CURVE, SIDES, 0)
    walls = [trimesh.Trimesh(np.concatenate([upper, lower]), cells, process=False) for upper, lower in (yellow, blue)]
    samples, _ = trimesh.sample.sample_surface_even(walls[0], 4000, seed=1)
    squared = igl.point_mesh_squared_distance(samples, walls[1].vertices, walls[1].faces)[0]
    assert gaps.min() >= np.sqrt(squared.min()) - 0.02
    assert gaps.min() <= np.sqrt(squared.min()) + 0.05


def test_measured_again_walls_are_as_far_apart_as_measured_anew() -> None:
    """A point that comes nearer, one that goes away, and one that a gap across the ring led to."""
    yellow, blue = prisms(inner=10.0, outer=10.4)
    yellow[0][5] += 0.2 * RING[5]
    before = WallGaps.of(yellow, blue)
    after = [[copy.copy() for copy in each] for each in (yellow, blue)]
    after[0][0][5] -= 0.3 * RING[5]
    after[1][1][15] -= 0.25 * RING[15]
    again = before.again(*after)
    assert again.gaps == pytest.approx(WallGaps.of(*after).gaps, abs=1e-12)
    assert again.gaps[5] > before.gaps[5] + 0.1
    assert again.gaps[15] < before.gaps[15] - 0.1


def test_gaps_that_led_to_a_place_that_moved_are_measured_again() -> None:
    """Blue's point 12 comes through to the far side of yellow and goes back: gaps on that side know of both."""
    yellow, blue = prisms(inner=10.0, outer=10.4)
    blue[0][12] = 9.95 * RING[0]
    before = WallGaps.of(yellow, blue)
    back = [blue[0].copy(), blue[1]]
    back[0][12] = 10.4 * RING[12]
    assert before.gaps[0] < 0.1
    assert before.again(yellow, back).gaps == pytest.approx(WallGaps.of(yellow, back).gaps, abs=1e-12)


def test_walls_that_have_not_moved_are_not_measured_again() -> None:
    before = WallGaps.of(*prisms(inner=10.0, outer=10.4))
    assert before.again(*prisms(inner=10.0, outer=10.4)) is before


def test_the_middle_gap_of_walls_that_part_downwards_is_that_halfway_down() -> None:
    yellow, blue = prisms(inner=10.0, outer=10.2)
    blue[1] = 10.6 * RING - DOWN
    gaps = middle_gaps(yellow, blue)
    lean = np.cos(np.arctan2(0.4, 2.0))
    assert gaps == pytest.approx(np.full(SIDES, 0.4 * lean), rel=0.05)
    assert wall_gaps(yellow, blue).max() < 0.21


def test_of_walls_with_rings_the_widest_counts_and_only_there() -> None:
    yellow, blue = ([radius * RING - share * DOWN for share in (0.0, 0.3, 0.7, 1.0)] for radius in (10.0, 10.3))
    narrow = middle_gaps(yellow, blue)
    blue[2][5] += 0.3 * RING[5]
    wide = middle_gaps(yellow, blue)
    assert wide.argmax() == 5
    assert wide[5] > narrow[5] + 0.1
    assert wide[15] == narrow[15]


def test_mid_lines_are_one_per_ring_or_halfway_down() -> None:
    yellow, blue = prisms(inner=10.0, outer=10.4)
    assert mid_lines(np.array([yellow, blue])) == pytest.approx((10.2 * RING - 0.5 * DOWN)[None])
    rings = [
        np.insert(np.array(each), 1, [each[0] - 0.2 * DOWN, each[0] - 0.6 * DOWN], axis=0) for each in (yellow, blue)
    ]
    assert mid_lines(np.array(rings)) == pytest.approx(np.stack([10.2 * RING - share * DOWN for share in (0.2, 0.6)]))
