"""Rows of vectors: lengths, scalar products, the smooth step."""

from __future__ import annotations

import numpy as np

from fabricate.picture.vectors import dots, smooth_step, unit

VECTORS = np.random.default_rng(1).normal(size=(50, 3))


def test_unit_vectors_have_length_one_and_keep_their_direction() -> None:
    units = unit(VECTORS)
    assert units.dtype == np.float32
    np.testing.assert_allclose(np.linalg.norm(units, axis=1), 1, atol=1e-6)
    np.testing.assert_allclose(np.cross(units, VECTORS), 0, atol=1e-6)


def test_a_zero_vector_stays_zero() -> None:
    np.testing.assert_array_equal(unit(np.zeros((1, 3))), np.zeros((1, 3)))


def test_dots_are_the_diagonal_of_the_matrix_product() -> None:
    left, right = VECTORS.astype(np.float32), VECTORS[::-1].astype(np.float32)
    np.testing.assert_allclose(dots(left, right), np.diag(left @ right.T), atol=1e-5)


def test_smooth_step_rises_from_zero_to_one_without_slope_at_the_ends() -> None:
    values = np.linspace(-1, 2, 301, dtype=np.float32)
    steps = smooth_step(values)
    assert (steps[values <= 0] == 0).all()
    assert (steps[values >= 1] == 1).all()
    assert (np.diff(steps) >= 0).all()
    assert steps[110] < 0.05
