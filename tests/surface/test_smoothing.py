"""Smoothing: constants stay, gaps are filled, spread grows as said, broad shapes keep their size."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import seeds

from fabricate.surface.smoothing import diffused, filled, low_pass, passes_over, steadied
from fabricate.triangles.adjacency import neighbour_distances, neighbour_means

BALL = trimesh.creation.icosphere(subdivisions=3)
POINTS = np.array(BALL.vertices)
MEANS = neighbour_means(np.array(BALL.faces), count=len(POINTS))


def flat_torus(side: int) -> np.ndarray:
    """Return the triangles of a regular triangulation, every point with six neighbours, that closes both ways."""
    i, j = np.divmod(np.arange(side * side), side)

    def number(a: int, b: int) -> np.ndarray:
        return np.asarray((i + a) % side * side + (j + b) % side)

    a, b, c, d = number(0, 0), number(1, 0), number(1, 1), number(0, 1)
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


@given(seed=seeds, passes=st.integers(0, 20))
def test_a_constant_stays_whatever_its_weights(seed: int, passes: int) -> None:
    random = np.random.default_rng(seed)
    weight = random.uniform(0.1, 1, len(POINTS))
    constant = np.tile(random.normal(size=3), (len(POINTS), 1))
    np.testing.assert_allclose(filled(constant, weight, MEANS, passes=passes), constant)
    np.testing.assert_allclose(low_pass(constant, MEANS, passes=passes), constant)


def test_without_passes_nothing_changes() -> None:
    np.testing.assert_allclose(filled(POINTS, np.full(len(POINTS), 0.3), MEANS, passes=0), POINTS)
    np.testing.assert_allclose(low_pass(POINTS, MEANS, passes=0), POINTS)


def test_a_gap_is_filled_from_around_and_what_it_held_is_forgotten() -> None:
    gap = POINTS[:, 2] > 0.9
    values: np.ndarray = np.where(gap[:, None], 1e6, np.ones((len(gap), 3)))
    np.testing.assert_allclose(filled(values, (~gap).astype(np.float64), MEANS, passes=20), 1.0)


def test_where_nothing_is_known_the_value_is_zero() -> None:
    assert not filled(POINTS, np.zeros(len(POINTS)), MEANS, passes=5).any()


SPACING = neighbour_distances(POINTS, np.array(BALL.faces))


@pytest.mark.parametrize("passes", [0, 4])
def test_values_that_stand_out_are_replaced_by_those_around(passes: int) -> None:
    moves = 0.1 * POINTS
    wrong = moves.copy()
    wrong[::37] += [3.0, -2.0, 1.0]
    found = steadied(wrong, np.ones(len(moves)), MEANS, SPACING, passes=passes)
    assert np.linalg.norm(found - moves, axis=1).max() < 0.05
    assert np.linalg.norm(filled(wrong, np.ones(len(moves)), MEANS, passes=passes) - moves, axis=1).max() > 0.2


def test_values_that_vary_no_more_than_places_do_stay() -> None:
    moves = 0.5 * np.sin(5.0 * POINTS)
    np.testing.assert_allclose(steadied(moves, np.ones(len(moves)), MEANS, SPACING, passes=0), moves, atol=0.01)


@pytest.mark.parametrize("length", [2.0, 3.5])
def test_a_peak_spreads_over_the_length_asked_for(length: float) -> None:
    side = 60
    means = neighbour_means(flat_torus(side), count=side * side)
    peak = np.zeros((side * side, 3))
    centre = side // 2 * side + side // 2
    peak[centre] = 1.0
    spread = filled(peak, np.ones(len(peak)), means, passes=passes_over(length, 1.0))[:, 0]
    i, j = np.divmod(np.arange(side * side), side)
    # rows and columns of the grid at 120 degrees, edges of length 1
    x, y = (i - side // 2) - 0.5 * (j - side // 2), np.sqrt(0.75) * (j - side // 2)
    for across in (x, y):
        assert np.sqrt(spread @ across**2) == pytest.approx(length, rel=0.05)


def test_a_broad_shape_keeps_its_size() -> None:
    """Averaging shrinks a sphere; giving back what it took leaves the square of that share."""
    passes = 20
    plain = filled(POINTS, np.ones(len(POINTS)), MEANS, passes=passes)
    lost, kept = 1 - np.linalg.norm(plain, axis=1), 1 - np.linalg.norm(low_pass(POINTS, MEANS, passes=passes), axis=1)
    assert lost.mean() > 0.05
    np.testing.assert_allclose(kept.mean(), lost.mean() ** 2, rtol=0.1)


def test_fine_detail_is_taken_out() -> None:
    noise = np.random.default_rng(3).normal(size=POINTS.shape)
    assert low_pass(noise, MEANS, passes=20).std() < 0.2 * noise.std()


def test_a_length_below_an_edge_takes_one_pass() -> None:
    assert passes_over(0.01, 1.0) == 1


def test_a_diffused_constant_stays() -> None:
    constant = np.tile([1.0, -2.0, 3.0], (len(POINTS), 1))
    np.testing.assert_allclose(diffused(constant, POINTS, np.array(BALL.faces), length=0.5), constant, atol=1e-6)


@pytest.mark.parametrize("length", [0.2, 0.5, 2.0])
def test_diffusion_on_the_unit_ball_shrinks_spherical_harmonics_as_the_heat_equation_says(length: float) -> None:
    """Coordinates are harmonics of degree 1, with eigenvalue 2; x y is one of degree 2, with eigenvalue 6."""
    values = np.stack([POINTS[:, 0], POINTS[:, 2], POINTS[:, 0] * POINTS[:, 1]], axis=1)
    time = (0.5 * length) ** 2
    wanted = values / (1.0 + time * np.array([2.0, 2.0, 6.0]))
    np.testing.assert_allclose(diffused(values, POINTS, np.array(BALL.faces), length=length), wanted, atol=0.01)


def test_diffusion_is_measured_on_the_surface_and_not_in_edges() -> None:
    """The same field on a ball that is four times as fine comes out the same."""
    fine = trimesh.creation.icosphere(subdivisions=5)
    coarse_field = diffused(POINTS, POINTS, np.array(BALL.faces), length=1.0)
    points = np.array(fine.vertices)
    fine_field = diffused(points, points, np.array(fine.faces), length=1.0)
    same = fine_field[trimesh.proximity.ProximityQuery(fine).vertex(POINTS)[1]]
    np.testing.assert_allclose(same, coarse_field, atol=0.01)
