"""Pieces: placed as matrices say, mirrored ones stay closed round the same volume, and equal points stay equal."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.formats.pieces import Piece, joined
from fabricate.mesh.closed import checked_closed, signed_volume

POINTS = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
TRIANGLES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])


def transform(seed: int) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:, :3] = np.random.default_rng(seed).normal(size=(4, 3))
    return matrix


@given(st.integers(0, 2**32 - 1))
def test_points_go_where_the_matrix_puts_them_and_the_volume_is_its_determinant(seed: int) -> None:
    matrix = transform(seed)
    mesh = joined([Piece(POINTS, TRIANGLES, matrix)])
    np.testing.assert_allclose(mesh.points, (np.column_stack([POINTS, np.ones(4)]) @ matrix)[:, :3], atol=1e-12)
    assert signed_volume(mesh) == pytest.approx(abs(np.linalg.det(matrix[:3, :3])) / 6, rel=1e-6, abs=1e-12)


def test_pieces_stay_apart_and_keep_their_order() -> None:
    away = np.eye(4)
    away[3, 0] = 5
    mesh = joined([Piece(POINTS, TRIANGLES, np.eye(4)), Piece(POINTS, TRIANGLES, away)])
    assert mesh.points.tolist() == [*POINTS.tolist(), *(POINTS + np.array([5, 0, 0])).tolist()]
    assert mesh.corners.reshape(-1, 3).tolist() == [*TRIANGLES.tolist(), *(TRIANGLES + 4).tolist()]
    checked_closed(joined([Piece(POINTS, TRIANGLES, away)]))


@given(st.integers(0, 2**32 - 1), st.integers(1, 40))
def test_equal_points_stay_equal(seed: int, count: int) -> None:
    points = np.repeat(np.random.default_rng(seed).normal(size=(1, 3)), count, axis=0)
    placed = joined([Piece(points, TRIANGLES[:0], transform(seed))]).points
    assert len(np.unique(placed, axis=0)) == 1


@pytest.mark.filterwarnings("error")
def test_overflow_is_left_to_whoever_checks_numbers() -> None:
    huge = np.diag([1e300, 1e300, 1e300, 1])
    assert np.isinf(joined([Piece(1e300 * POINTS, TRIANGLES, huge)]).points).any()


def test_no_pieces_are_an_empty_mesh() -> None:
    assert len(joined([]).corners) == len(joined([]).points) == 0
