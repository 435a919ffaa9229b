"""Deviation: concentric spheres, spikes that stand out, and places spread as evenly as the area."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from fabricate.surface.deviation import SAMPLES, deviation, spread

BALL = trimesh.creation.icosphere(subdivisions=4)
POINTS, TRIANGLES = np.array(BALL.vertices), np.array(BALL.faces)
BOX = trimesh.creation.box(extents=(1, 2, 3))


def test_a_surface_does_not_deviate_from_itself() -> None:
    found = deviation(POINTS, TRIANGLES, POINTS, TRIANGLES)
    assert found.max < 1e-12


def test_concentric_spheres_are_apart_by_the_difference_of_their_radii() -> None:
    found = deviation(20.0 * POINTS, TRIANGLES, 21.0 * POINTS, TRIANGLES)
    sagitta = 21.0 * (1.0 - np.cos(0.5 * BALL.edges_unique_length.max()))
    for distance in (found.mean, found.p999, found.max):
        assert distance == pytest.approx(1.0, abs=1.5 * sagitta)
    assert found.mean <= found.p999 <= found.max


def test_what_the_outer_surface_lacks_is_found_and_named() -> None:
    spiked = POINTS.copy()
    spiked[17] *= 1.5
    found = deviation(POINTS, TRIANGLES, spiked, TRIANGLES)
    assert found.max == pytest.approx(0.5, rel=1e-3)
    np.testing.assert_allclose(found.at, spiked[17])
    assert found.mean < 0.01


def test_what_the_outer_surface_has_more_is_seen_from_the_other_side_only() -> None:
    spiked = POINTS.copy()
    spiked[17] *= 1.5
    assert deviation(spiked, TRIANGLES, POINTS, TRIANGLES).max < 0.2
    assert deviation(POINTS, TRIANGLES, spiked, TRIANGLES).max > 0.4


@given(shift=st.tuples(*[st.floats(-1, 1)] * 3))
@settings(max_examples=5)
def test_a_shifted_surface_deviates_by_no_more_than_the_shift(shift: tuple[float, float, float]) -> None:
    points, triangles = np.array(BOX.vertices), np.array(BOX.faces)
    found = deviation(points + shift, triangles, points, triangles)
    assert found.max <= np.linalg.norm(shift) + 1e-9


def test_the_place_is_read_only() -> None:
    with pytest.raises(ValueError, match="read-only"):
        deviation(POINTS, TRIANGLES, POINTS, TRIANGLES).at[0] = 1.0


@pytest.mark.parametrize("count", [1, 1000, SAMPLES])
def test_places_lie_on_the_surface(count: int) -> None:
    places = spread(np.array(BOX.vertices), np.array(BOX.faces), count=count)
    assert places.shape == (count, 3)
    off = np.abs(np.abs(places) - np.array(BOX.extents) / 2).min(axis=1)
    assert off.max() < 1e-12
    assert (np.abs(places) <= np.array(BOX.extents) / 2 + 1e-12).all()


def test_each_side_of_a_box_gets_places_by_its_area() -> None:
    count = 20_000
    places = spread(np.array(BOX.vertices), np.array(BOX.faces), count=count)
    for axis, area in enumerate((6.0, 3.0, 2.0)):
        on_side = np.isclose(places[:, axis], BOX.extents[axis] / 2)
        assert on_side.sum() == pytest.approx(count * area / 22.0, abs=8)


def test_places_fill_a_triangle_evenly() -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=float)
    u, v, _ = spread(points, np.array([[0, 1, 2]]), count=10_000).T
    assert np.mean([u, v]) == pytest.approx(1 / 3, abs=1e-3)
    # halves of a triangle by the lines parallel to its sides
    for part in (u < 1 - np.sqrt(0.5), v < 1 - np.sqrt(0.5), u + v > np.sqrt(0.5)):
        assert part.mean() == pytest.approx(0.5, abs=5e-3)


def test_places_are_always_the_same() -> None:
    first, second = (spread(POINTS, TRIANGLES, count=500) for _ in range(2))
    assert (first == second).all()
