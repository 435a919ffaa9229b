"""Squaring: squares stay, nearest squares are the nearest, pushed tiles grow, and nothing leaves the surface."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from crowding import crowded_box, roomy_torus
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fabricate.duotone.quad_mesh import two_coloured
from fabricate.mesh.cube import cube
from fabricate.surface.squaring import nearest_squares, squared

SQUARE = np.array([[1, 1, 0], [-1, 1, 0], [-1, -1, 0], [1, -1, 0]], dtype=float) / 2


@given(arrays(np.float64, (4, 2), elements=st.floats(-0.3, 0.3)), st.floats(0.5, 2.0))
@settings(max_examples=40)
def test_no_square_in_the_plane_is_nearer(shift: np.ndarray, side: float) -> None:
    corners = SQUARE + np.pad(shift, ((0, 0), (0, 1)))
    found = nearest_squares(corners[None], np.array([side]))[0]
    sides = np.linalg.norm(np.roll(found, -1, axis=0) - found, axis=1)
    np.testing.assert_allclose(sides, side, rtol=1e-12)
    best = np.square(found - corners).sum()
    for angle in np.linspace(0, 2 * np.pi, 73):
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        other = side * SQUARE @ turn.T + corners.mean(axis=0)
        assert np.square(other - corners).sum() >= best - 1e-9


def test_squares_of_the_right_side_stay() -> None:
    quads = two_coloured(cube(divisions=6).scaled(12.0))
    ones = np.ones(len(quads.tiles))
    kept = squared(quads, sides=4.0 * ones, weights=ones).points
    inside = np.sort(np.abs(quads.points), axis=1)[:, 1] < 11.0
    np.testing.assert_allclose(kept[inside], quads.points[inside], atol=1e-12)


def test_a_pushed_tile_grows_at_the_cost_of_those_around_it() -> None:
    quads = roomy_torus().quads
    sides, weights = np.full(len(quads.tiles), 12.0), np.ones(len(quads.tiles))
    for _ in range(5):
        quads = squared(quads, sides=sides, weights=weights)
    pushed = replace(quads)
    sides[7], weights[7] = 1.3 * 12.0, 4.0
    for _ in range(5):
        quads, pushed = (
            squared(quads, sides=np.full_like(sides, 12.0), weights=np.ones_like(weights)),
            squared(pushed, sides=sides, weights=weights),
        )

    def perimeters(points: np.ndarray) -> np.ndarray:
        corners = points[quads.tiles]
        return np.asarray(np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2).sum(axis=1))

    growth = perimeters(pushed.points) / perimeters(quads.points)
    assert growth[7] > 1.1
    assert growth.min() < 0.97


def test_sharp_edges_stay_sharp() -> None:
    quads = crowded_box().quads
    ones = np.ones(len(quads.tiles))
    after = squared(quads, sides=5.0 * ones, weights=ones).points
    on_edges = quads.crease_counts == 2
    np.testing.assert_allclose(np.sort(np.abs(after[on_edges]), axis=1)[:, 1:], 30.0, atol=1e-9)
    assert (after[quads.crease_counts > 2] == quads.points[quads.crease_counts > 2]).all()
