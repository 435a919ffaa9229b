from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import seeds
from scipy.sparse import csr_array

from fabricate.surface.conjugate_gradients import solved


def system(seed: int, size: int) -> tuple[np.ndarray, np.ndarray]:
    """Return a random positive definite matrix of moderate condition, and three right sides."""
    random = np.random.default_rng(seed)
    factor = random.normal(size=(size, size))
    return factor @ factor.T + size * np.eye(size), random.normal(size=(size, 3))


@given(seed=seeds, size=st.integers(1, 30))
def test_the_solution_is_that_of_elimination(seed: int, size: int) -> None:
    matrix, right = system(seed, size)
    found = solved(csr_array(matrix), right, np.zeros_like(right), free=lambda change: change)
    assert np.linalg.norm(matrix @ found - right) <= 1e-3 * np.linalg.norm(right)


@given(seed=seeds, size=st.integers(3, 30))
def test_what_is_not_free_stays_and_the_rest_solves_its_own_rows(seed: int, size: int) -> None:
    matrix, right = system(seed, size)
    start = np.random.default_rng(seed + 1).normal(size=right.shape)
    held = np.arange(size) % 3 == 0
    found = solved(csr_array(matrix), right, start, free=lambda change: np.where(held[:, None], 0.0, change))
    np.testing.assert_array_equal(found[held], start[held])
    before, after = ((right - matrix @ field)[~held] for field in (start, found))
    assert np.linalg.norm(after) <= 1e-3 * np.linalg.norm(before)


def test_a_solution_is_left_alone() -> None:
    matrix, right = system(1, 5)
    exact = np.linalg.solve(matrix, right)
    found = solved(csr_array(matrix), matrix @ exact, exact, free=lambda change: change)
    np.testing.assert_allclose(found, exact, atol=1e-12)
