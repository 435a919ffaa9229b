"""Paths of wires: they follow the curve, bend no more sharply than the wire can, and say where strands meet."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fabricate.solid.wire_path import SHARPEST, WirePath, meets_itself, wire_path


def circle(radius: float, count: int = 80) -> np.ndarray:
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)


def square(side: float, count: int = 40) -> np.ndarray:
    way = np.linspace(0, side, count, endpoint=False)
    sides = ((way, 0 * way), (side + 0 * way, way), (side - way, side + 0 * way), (0 * way, side - way))
    return np.concatenate([np.stack([x, y, 0 * x], axis=1) for x, y in sides])


def stadium(length: float, gap: float) -> np.ndarray:
    """Two straight strands a gap apart, joined by half circles that bulge to a radius of 5."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, 40)
    way = np.linspace(-length / 2, length / 2, 60)[1:-1]
    bulge = 5.0 - gap / 2
    width = gap / 2 + bulge * (2 * np.abs(way) / length) ** 8
    right = np.stack([length / 2 + 5 * np.cos(angle), 5 * np.sin(angle)], axis=1)
    top, bottom = np.stack([way[::-1], width[::-1]], axis=1), np.stack([way, -width], axis=1)
    flat = np.concatenate([right, top, -right, bottom])
    return np.column_stack([flat, np.zeros(len(flat))])


def turning(path: WirePath) -> np.ndarray:
    ahead = np.roll(path.points, -1, axis=0) - path.points
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    return np.arccos(np.clip((ahead * np.roll(ahead, 1, axis=0)).sum(axis=1), -1, 1))


def found(path: WirePath | None) -> WirePath:
    assert path is not None
    return path


def test_a_circle_stays_a_circle() -> None:
    path = found(wire_path(circle(10), radius=1, tolerance=0.001))
    assert np.linalg.norm(path.points, axis=1) == pytest.approx(10, abs=1e-3)
    assert path.length == pytest.approx(20 * np.pi, rel=1e-3)
    assert np.abs((path.points * path.tangents).sum(axis=1)).max() < 1e-3


@given(tolerance=st.floats(0.002, 0.1), radius=st.floats(0.5, 6))
@settings(max_examples=25)
def test_the_chord_error_outside_a_bend_is_within_the_tolerance(tolerance: float, radius: float) -> None:
    path = found(wire_path(circle(10), radius=radius, tolerance=tolerance))
    outside = path.points * (1 + radius / 10)
    middles = 0.5 * (outside + np.roll(outside, -1, axis=0))
    assert (10 + radius - np.linalg.norm(middles, axis=1)).max() <= 1.05 * tolerance


def test_a_corner_is_rounded_as_the_wire_bends_and_the_sides_stay() -> None:
    path = found(wire_path(square(30), radius=1.5, tolerance=0.005))
    bend = turning(path) / path.steps
    assert bend.max() <= 1.1 / (SHARPEST * 1.5)
    x, y = np.abs(path.points[:, :2] - 15).T
    in_a_corner = np.minimum(x, y) > 15 - 6
    assert np.maximum(x, y)[~in_a_corner] == pytest.approx(15, abs=1e-3)
    assert 0.2 < np.linalg.norm(15 - np.stack([x, y]), axis=0).min() < 1.5


def test_a_wire_too_thick_for_the_curve_has_no_path() -> None:
    assert wire_path(circle(10), radius=11, tolerance=0.01) is None
    assert wire_path(square(10), radius=5, tolerance=0.01) is None
    assert wire_path(circle(10), radius=1e5, tolerance=0.01) is None


@pytest.mark.parametrize("gap", [2.0, 3.0])
def test_strands_meet_where_they_are_nearer_than_the_diameter(gap: float) -> None:
    path = found(wire_path(stadium(40, gap), radius=0.5, tolerance=0.01))
    assert not meets_itself(path, diameter=0.98 * gap)
    assert meets_itself(path, diameter=1.02 * gap)


def test_what_lies_along_one_strand_does_not_meet() -> None:
    path = found(wire_path(circle(10), radius=9, tolerance=0.01))
    assert not meets_itself(path, diameter=18)
