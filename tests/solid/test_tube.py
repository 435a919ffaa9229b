"""Tubes: closed, of genus 1, of the right volume, and turned no more than their path asks for."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fabricate.checks.geometry import signed_volume
from fabricate.checks.topology import topology
from fabricate.solid.part import Part
from fabricate.solid.tube import tube
from fabricate.solid.wire_path import WirePath
from fabricate.triangles.crossing import crossing_triangles


def path(twists: int, *, height: float = 3.0, count: int = 400) -> WirePath:
    """A closed line that goes up and down so often on its way round a circle of radius 10."""
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    points = np.stack([10 * np.cos(angle), 10 * np.sin(angle), height * np.sin(twists * angle)], axis=1)
    ahead = np.stack([-10 * np.sin(angle), 10 * np.cos(angle), twists * height * np.cos(twists * angle)], axis=1)
    return WirePath(points, ahead / np.linalg.norm(ahead, axis=1, keepdims=True))


def knot(count: int = 600) -> WirePath:
    """A trefoil: its frame comes back turned by an angle of no special size."""
    t = np.linspace(0, 2 * np.pi, count, endpoint=False)
    points = 5 * np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], axis=1)
    ahead = np.stack([np.cos(t) + 4 * np.cos(2 * t), -np.sin(t) + 4 * np.sin(2 * t), -3 * np.cos(3 * t)], axis=1)
    return WirePath(points, ahead / np.linalg.norm(ahead, axis=1, keepdims=True))


def turns(part: Part, rings: int) -> np.ndarray:
    """How far each ring is turned against the one before it, about the way between them, radians."""
    grid = part.points.reshape(rings, -1, 3)
    middles = grid.mean(axis=1)
    way = np.roll(middles, -1, axis=0) - middles
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    own = grid[:, 0] - middles
    other = np.roll(own, -1, axis=0)
    flat = [each - (each * way).sum(axis=1, keepdims=True) * way for each in (own, other)]
    sine = (np.cross(*flat) * way).sum(axis=1)
    return np.arctan2(sine, (flat[0] * flat[1]).sum(axis=1))[:-1]


@given(twists=st.integers(0, 5), radius=st.floats(0.2, 1.0), tolerance=st.floats(0.005, 0.2))
@settings(max_examples=20)
def test_a_tube_is_one_closed_solid_of_genus_1(twists: int, radius: float, tolerance: float) -> None:
    part = tube(path(twists), radius=radius, tolerance=tolerance, name="wire")
    connected = topology(part, expected_genus=1)
    assert not [check.message for check in connected.checks if not check.ok]
    assert not len(crossing_triangles(part.points, part.triangles))
    assert signed_volume(part) == pytest.approx(np.pi * radius**2 * path(twists).length, rel=0.04)


@pytest.mark.parametrize("line", [path(0), path(3), knot()])
def test_no_side_is_nearer_to_the_middle_than_the_radius(line: WirePath) -> None:
    part = tube(line, radius=0.8, tolerance=0.02, name="wire")
    grid = part.points.reshape(len(line.points), -1, 3) - line.points[:, None]
    assert np.abs((grid * line.tangents[:, None]).sum(axis=2)).max() < 1e-5
    sides = 0.5 * (grid + np.roll(grid, 1, axis=1))
    assert np.linalg.norm(sides, axis=2) == pytest.approx(0.8, abs=1e-5)
    assert np.linalg.norm(grid, axis=2).max() <= 0.82 + 1e-5


@pytest.mark.parametrize("line", [path(0), path(4), knot()])
def test_rings_turn_evenly_and_hardly_at_all(line: WirePath) -> None:
    part = tube(line, radius=0.5, tolerance=0.01, name="wire")
    turned = turns(part, len(line.points))
    sides = len(part.points) // len(line.points)
    assert np.abs(turned).max() <= np.pi / sides / len(line.points) * 3 + 2e-4


def test_the_last_ring_meets_the_first() -> None:
    line = knot()
    part = tube(line, radius=0.5, tolerance=0.01, name="wire")
    corners = part.points[part.triangles]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max()
    sides = len(part.points) // len(line.points)
    assert longest < 1.5 * np.hypot(line.steps.max() * 1.1, 2 * np.pi * 0.5 / sides)
