"""Triangles near others: none is missed, and few are named that are not near."""

from __future__ import annotations

import numpy as np
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import seeds

from fabricate.arrays import Floats, Indices, Mask
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.nearby import MOST_CELLS, triangles_near

FLAT = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], dtype=float)
TWO = np.arange(6).reshape(2, 3)


def scattered(random: np.random.Generator, count: int, spread: float) -> tuple[Floats, Indices]:
    centres = random.uniform(-spread, spread, (count, 1, 3))
    points = (centres + random.normal(size=(count, 3, 3)) * random.uniform(0.05, 1, (count, 1, 1))).reshape(-1, 3)
    return points, np.arange(3 * count).reshape(-1, 3)


def some(random: np.random.Generator, count: int) -> Mask:
    chosen: Mask = np.zeros(count, dtype=bool)
    chosen[random.integers(count, size=1 + count // 6)] = True
    return chosen


@given(seed=seeds, count=st.integers(2, 40), spread=st.floats(0.1, 5.0))
@settings(max_examples=60)
def test_no_partner_of_a_moved_triangle_is_missed(seed: int, count: int, spread: float) -> None:
    random = np.random.default_rng(seed)
    points, triangles = scattered(random, count, spread)
    moved = some(random, len(points))
    near = set(triangles_near(points, triangles, moved).tolist())
    own = np.asarray(moved[triangles].any(axis=1))
    assert set(np.flatnonzero(own).tolist()) <= near
    pairs = crossing_triangles(points, triangles)
    assert set(pairs[own[pairs].any(axis=1)].ravel().tolist()) <= near


@given(seed=seeds, count=st.integers(2, 40), spread=st.floats(0.1, 5.0), reach=st.floats(0.0, 3.0))
@settings(max_examples=60)
def test_none_within_reach_is_missed(seed: int, count: int, spread: float, reach: float) -> None:
    random = np.random.default_rng(seed)
    points, triangles = scattered(random, count, spread)
    moved = some(random, len(points))
    near = np.isin(np.arange(count), triangles_near(points, triangles, moved, reach=reach))
    own = np.asarray(moved[triangles].any(axis=1))
    places = points[triangles[own]].reshape(-1, 3)
    for number in np.flatnonzero(~near):
        closest = trimesh.triangles.closest_point(np.tile(points[triangles[number]], (len(places), 1, 1)), places)
        assert np.linalg.norm(closest - places, axis=1).min() > reach


def test_on_a_fine_sphere_a_triangle_is_near_few_others() -> None:
    sphere = trimesh.creation.icosphere(subdivisions=6)
    points, triangles = np.asarray(sphere.vertices), np.asarray(sphere.faces)
    moved = np.isin(np.arange(len(points)), [0])
    near = triangles_near(points, triangles, moved, reach=0.1)
    away = np.linalg.norm(points[triangles[near]] - points[0], axis=2).min(axis=1)
    assert away.max() < 0.1 * np.sqrt(3) + 4 * (2 / MOST_CELLS) + 0.1


def test_no_triangles_are_near_nothing() -> None:
    assert len(triangles_near(FLAT, np.zeros((0, 3), dtype=np.int64), np.ones(3, dtype=bool))) == 0


def test_triangles_in_one_point_are_near_each_other() -> None:
    moved = np.isin(np.arange(6), [0])
    assert triangles_near(np.ones((6, 3)), TWO, moved).tolist() == [0, 1]


def test_far_triangles_are_left_out() -> None:
    points = np.concatenate([FLAT, FLAT + 100.0])
    moved = np.isin(np.arange(6), [1])
    assert triangles_near(points, TWO, moved).tolist() == [0]


def test_nothing_moved_is_near_nothing() -> None:
    assert len(triangles_near(FLAT, TWO[:1], np.zeros(3, dtype=bool))) == 0
