"""Edge lengths asked for on a surface: refined where told to, and nowhere growing too fast."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from polyhedra import seeds

from fabricate.mesh.sphere import sphere
from fabricate.prepare.sizing_field import GRADING, REFINEMENT, SMALLEST, SizingField
from fabricate.prepare.triangle_mesh import edges, fanned

BALL = fanned(sphere(faces="triangles", frequency=6))
EVEN = SizingField.even(BALL, length=1.0)


def test_an_even_field_is_the_same_everywhere() -> None:
    assert EVEN.at(np.random.default_rng(1).normal(size=(20, 3))) == pytest.approx(1.0)


@given(seeds)
def test_lengths_are_the_largest_that_grow_slowly_enough(seed: int) -> None:
    where = np.random.default_rng(seed).random(len(BALL.points)) < 0.02
    refined = EVEN.refined(where).refined(where)
    wanted = np.where(where, REFINEMENT**2, 1.0)
    joined = edges(BALL)
    step = GRADING * joined.lengths(BALL.points)
    for _ in range(30):  # plain relaxation, as an oracle of the shortest paths
        for k in range(2):
            np.minimum.at(wanted, joined.ends[:, k], wanted[joined.ends[:, 1 - k]] + step)
    assert refined.lengths == pytest.approx(wanted)


def test_lengths_stop_getting_shorter() -> None:
    field = EVEN
    everywhere_but_one = np.arange(len(BALL.points)) > 0
    for _ in range(20):
        field = field.refined(everywhere_but_one)
    assert field.lengths.min() >= SMALLEST * field.lengths.max()


def test_nothing_to_refine_changes_nothing() -> None:
    assert EVEN.refined(np.zeros(len(BALL.points), dtype=bool)).lengths == pytest.approx(1.0)


def test_lengths_are_read_only() -> None:
    with pytest.raises(ValueError, match="read-only"):
        EVEN.lengths[0] = 2.0
