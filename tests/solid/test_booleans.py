"""Booleans: parts go to Manifold and come back, and bars have the size and the place they should have."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.errors import SolidError
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.solid.booleans import Cylinder, bar, manifold_of, part_of, united
from fabricate.solid.part import Part


def ball() -> Part:
    mesh = geodesic_sphere(frequency=3)
    return Part("ball", 10 * mesh.points, mesh.corners.reshape(-1, 3))


def test_a_part_comes_back_as_it_was() -> None:
    part = ball()
    again = part_of("ball", manifold_of(part))
    assert np.array_equal(np.unique(again.points, axis=0), np.unique(part.points, axis=0))
    assert len(again.triangles) == len(part.triangles)


def test_nothing_is_empty() -> None:
    assert manifold_of(Part("none", np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))).is_empty()


def test_what_is_open_is_refused() -> None:
    part = ball()
    with pytest.raises(SolidError, match="ball is no solid"):
        manifold_of(Part("ball", part.points, part.triangles[1:]))


@pytest.mark.parametrize("way", [(0, 0, 1), (0, 0, -1), (1, 0, 0), (1, -2, 3)])
def test_a_bar_reaches_from_end_to_end_and_holds_the_area_of_its_circle(way: tuple[float, float, float]) -> None:
    begin, direction = np.array([1.0, 2.0, 3.0]), np.array(way, dtype=float)
    made = bar(Cylinder(begin, begin + direction, 0.7), tolerance=0.01, turn=3.0)
    length = float(np.linalg.norm(direction))
    assert made.volume() == pytest.approx(np.pi * 0.7**2 * length, rel=1e-6)
    points = part_of("bar", made).points - begin
    along = points @ direction / length
    assert (along.min(), along.max()) == pytest.approx((0.0, length), abs=1e-6)
    around = np.linalg.norm(points - along[:, None] * direction / length, axis=1)
    assert around == pytest.approx(np.full(len(around), 0.7), rel=0.01)


def test_the_union_of_bars_that_touch_nothing_has_all_their_volume() -> None:
    bars = [bar(Cylinder(np.array([x, 0, 0]), np.array([x, 0, 1.0]), 0.2), tolerance=0.01) for x in (0.0, 1.0)]
    whole = united(bars)
    assert whole.volume() == pytest.approx(2 * bars[0].volume())
    assert len(whole.decompose()) == 2
