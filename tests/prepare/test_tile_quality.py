"""Evenness of tiles: known for rectangles, blind to place, size and order, and warned of beyond the limits."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.prepare.tile_quality import MOST_ASPECT, MOST_SPREAD, tile_quality


def rectangles(widths: list[float], heights: list[float]) -> np.ndarray:
    unit = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    return np.array([unit * [width, height, 1] for width, height in zip(widths, heights, strict=True)])


def test_squares_are_even() -> None:
    quality = tile_quality(rectangles([2.0] * 9, [2.0] * 9))
    assert (quality.aspect_median, quality.aspect_p95, quality.aspect_max, quality.size_ratio) == (1, 1, 1, 1)
    assert quality.warnings == ()


@given(st.lists(st.floats(0.1, 10), min_size=1, max_size=30))
def test_aspects_of_rectangles_are_known(widths: list[float]) -> None:
    quality = tile_quality(rectangles(widths, [1.0] * len(widths)))
    aspects = sorted(max(width, 1 / width) for width in widths)
    assert quality.aspect_max == pytest.approx(aspects[-1])
    assert aspects[0] * (1 - 1e-9) <= quality.aspect_median <= quality.aspect_p95 <= quality.aspect_max


@given(st.integers(0, 2**32 - 1), st.floats(0.01, 100))
def test_place_size_and_order_do_not_matter(seed: int, scale: float) -> None:
    rng = np.random.default_rng(seed)
    tiles = rng.normal(size=(20, 4, 3))
    rotation, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    moved = scale * rng.permutation(np.roll(tiles, rng.integers(4), axis=1)) @ rotation + rng.normal(size=3)
    first, second = tile_quality(tiles), tile_quality(moved)
    assert second.aspect_p95 == pytest.approx(first.aspect_p95)
    assert second.aspect_max == pytest.approx(first.aspect_max)
    assert second.size_ratio == pytest.approx(first.size_ratio)


def test_long_tiles_are_warned_of() -> None:
    long = 2 * MOST_ASPECT
    quality = tile_quality(rectangles([1.0] * 9 + [2 * long / (1 + long)], [1.0] * 9 + [2 / (1 + long)]))
    assert len(quality.warnings) == 1
    assert "6 times as long as wide" in quality.warnings[0]


def test_few_long_tiles_are_not_warned_of() -> None:
    assert tile_quality(rectangles([1.0] * 99 + [2 * MOST_ASPECT], [1.0] * 100)).warnings == ()


def test_uneven_sizes_are_warned_of() -> None:
    sizes = [1.0] * 10 + [2 * MOST_SPREAD] * 10
    quality = tile_quality(rectangles(sizes, sizes))
    assert quality.size_ratio == pytest.approx(2 * MOST_SPREAD)
    assert len(quality.warnings) == 1
    assert "6 times the side of small ones" in quality.warnings[0]


def test_tiles_without_extent_are_infinitely_long_or_none() -> None:
    quality = tile_quality(rectangles([1.0, 0.0], [0.0, 0.0]))
    assert quality.aspect_max == np.inf
    assert quality.aspect_median == 1
