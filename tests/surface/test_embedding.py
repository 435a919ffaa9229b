"""Faults of a surface: planted crossings, folds and collapsed triangles are found at their points, and no others."""

from __future__ import annotations

import numpy as np
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fabricate.arrays import Mask
from fabricate.surface.embedding import OPEN, Embedding, stored

BALL = trimesh.creation.icosphere(subdivisions=2)
POINTS, TRIANGLES = stored(np.array(BALL.vertices)), np.array(BALL.faces)
EMBEDDING = Embedding.of(TRIANGLES, count=len(POINTS))
ALL: Mask = np.ones(len(POINTS), dtype=bool)


def pushed_through(point: int) -> np.ndarray:
    points = POINTS.copy()
    points[point] *= -1.5
    return points


def test_a_sphere_has_no_fault() -> None:
    assert not EMBEDDING.crossed(POINTS, ALL).any()
    assert not (EMBEDDING.openness(POINTS) < OPEN).any()


def test_openness_is_the_cosine_of_the_steepest_side() -> None:
    """Over a square pyramid of height h the tip's sides are steep by the angle between them and its axis."""
    for height in (0.1, 1.0, 10.0):
        points = np.array([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, height]], dtype=float)
        triangles = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 2], [0, 3, 2]])
        openness = Embedding.of(triangles, count=5).openness(points)
        assert np.isclose(openness[4], 1.0 / np.sqrt(1.0 + 2.0 * height**2), rtol=1e-12)


def test_a_point_pushed_through_the_other_side_crosses_it() -> None:
    found = EMBEDDING.crossed(pushed_through(5), ALL)
    assert found[5]
    assert 3 < found.sum() < len(POINTS) / 2


def test_only_the_neighbourhood_of_what_moved_is_looked_at_and_that_is_enough() -> None:
    moved = np.arange(len(POINTS)) == 5
    found = EMBEDDING.crossed(pushed_through(5), moved)
    assert (found == EMBEDDING.crossed(pushed_through(5), ALL)).all()
    assert not EMBEDDING.crossed(pushed_through(5), np.zeros_like(moved)).any()


def test_folds_around_what_moved_are_those_of_the_whole_surface_and_no_others() -> None:
    points, least = pushed_through(5), np.full(len(POINTS), OPEN)
    moved = np.arange(len(POINTS)) == 5
    everywhere = EMBEDDING.openness(points) < OPEN
    assert everywhere.any()
    assert (EMBEDDING.folded(points, moved, least=least) == everywhere).all()
    elsewhere = np.arange(len(POINTS)) == int(POINTS[5].dot(POINTS.T).argmin())
    assert not EMBEDDING.folded(points, elsewhere, least=least).any()


def test_a_triangle_without_area_is_a_fault() -> None:
    points = POINTS.copy()
    first, second = TRIANGLES[7, :2]
    points[first] = points[second]
    found = EMBEDDING.crossed(points, ALL)
    assert found[[first, second]].all()


def folded_over() -> np.ndarray:
    """Return the sphere with one point moved within the surface beyond the far edge of a triangle at it."""
    points = POINTS.copy()
    corner, left, right = TRIANGLES[11]
    points[corner] += 1.3 * (points[[left, right]].mean(axis=0) - points[corner])
    points[corner] *= 1.001
    return points


def test_a_triangle_turned_over_makes_folds() -> None:
    found = EMBEDDING.openness(folded_over()) < OPEN
    assert found.any()
    near = np.unique(TRIANGLES[(TRIANGLES[11, 0] == TRIANGLES).any(axis=1)])
    assert np.isin(np.flatnonzero(found), near).all()


def test_a_blade_is_a_fold_only_if_it_was_none_before() -> None:
    blade = stored(POINTS * [1.0, 1.0, 0.01])
    fresh, known = EMBEDDING.faults_since(POINTS)(blade, ALL), EMBEDDING.faults_since(blade)(blade, ALL)
    assert fresh.any()
    assert np.abs(POINTS[fresh, 2]).max() < 0.5
    assert not known.any()
    assert EMBEDDING.faults_since(blade)(pushed_through(5), ALL)[5]


@given(values=arrays(np.float64, (5, 3), elements=st.floats(-1e3, 1e3)))
def test_what_is_stored_survives_a_file(values: np.ndarray) -> None:
    once = stored(values)
    assert (once.astype(np.float32) == once).all()
    assert (stored(once) == once).all()
    np.testing.assert_allclose(once, values, rtol=1e-6, atol=1e-30)
    assert not np.signbit(once[once == 0]).any()
