"""Alignment: 1 along the field, 0 across it, and what a weighted tree reaches."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from polyhedra import seeds
from round_tiles import round_tiles

from fabricate.config import DirectionConfig
from fabricate.design.alignment import alignment, alignment_costs
from fabricate.design.direction_field import tile_directions
from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.spanning_tree import random_duotone, uniform_duotone, weighted_duotone
from fabricate.mesh.cube import cube
from fabricate.surface.limit import limit_vertices

BALL = round_tiles()
CIRCLES = tile_directions(BALL, DirectionConfig(kind="direction", lines="circles"))


def test_diagonals_of_squares_are_at_right_angles() -> None:
    quads = subdivided(cube(divisions=4), levels=2)
    corners = limit_vertices(quads)[quads.tiles]
    yellow = corners[:, 2] - corners[:, 0]
    costs = alignment_costs(quads, yellow / np.linalg.norm(yellow, axis=1, keepdims=True))
    assert costs[:, 0] == pytest.approx(1.0)
    assert np.median(costs[:, 1]) < 0.1


def test_the_joined_diagonal_counts() -> None:
    corners = limit_vertices(BALL)[BALL.tiles]
    yellow = corners[:, 2] - corners[:, 0]
    along = yellow / np.linalg.norm(yellow, axis=1, keepdims=True)
    every = np.ones(len(BALL.tiles), dtype=bool)
    assert alignment(Duotone(BALL, every), along) == pytest.approx(1.0)
    assert alignment(Duotone(BALL, ~every), along) < 0.4


def test_the_sign_of_a_direction_does_not_count() -> None:
    duotone = random_duotone(BALL, seed=1)
    assert alignment(duotone, -CIRCLES) == alignment(duotone, CIRCLES)


def test_tiles_without_a_direction_do_not_count() -> None:
    duotone, some = random_duotone(BALL, seed=1), CIRCLES.copy()
    costs = alignment_costs(BALL, CIRCLES)
    joined = np.where(duotone.joined, costs[:, 0], costs[:, 1])
    some[::2] = 0.0
    assert alignment(duotone, some) == pytest.approx(joined[1::2].mean())
    assert alignment(duotone, 0.0 * some) == 0.0


def test_trees_reach_what_was_asked_for() -> None:
    costs = alignment_costs(BALL, CIRCLES)
    gain = costs[:, 0] - costs[:, 1]
    assert alignment(random_duotone(BALL, seed=1), CIRCLES) == pytest.approx(2 / np.pi, abs=0.04)
    assert alignment(weighted_duotone(BALL, -gain), CIRCLES) >= 0.87
    assert alignment(weighted_duotone(BALL, gain), CIRCLES) <= 0.40


@given(seed=seeds)
def test_no_tree_is_better_aligned_than_the_weighted_one(seed: int) -> None:
    costs = alignment_costs(BALL, CIRCLES)
    gain = costs[:, 0] - costs[:, 1]
    least, most = (alignment(weighted_duotone(BALL, sign * gain), CIRCLES) for sign in (1, -1))
    assert least < alignment(uniform_duotone(BALL, seed=seed), CIRCLES) < most
