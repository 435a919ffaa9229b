"""Facing walls: distances between prisms, cones and walls that come near each other at one place."""

from __future__ import annotations

import igl
import numpy as np
import pytest
import trimesh

from fabricate.arrays import Floats
from fabricate.solid.facing import wall_gaps
from fabricate.solid.layers import wall

SIDES = 24
TURN = np.arange(SIDES) * (2 * np.pi / SIDES)
RING = np.stack([np.cos(TURN), np.sin(TURN), np.zeros(SIDES)], axis=1)
CURVE = np.arange(SIDES)
DOWN = np.array([0.0, 0.0, 2.0])


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
