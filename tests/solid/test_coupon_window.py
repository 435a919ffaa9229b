"""Windows: the largest in which a piece has a flat back, nothing leans too much and nothing else comes in."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from coupons import CLEARANCE, THICKNESS, subject

from fabricate.arrays import Floats
from fabricate.solid.coupon_places import CouponPlace, neck_places
from fabricate.solid.coupon_window import CouponWindow, widest_window

BORDER, RIM = 0.5, 0.8


@pytest.fixture(scope="module")
def inner() -> Floats:
    return subject("ring").solids(CLEARANCE).inner


def found(
    place: CouponPlace, inner: Floats, *, widest: float = 6.0, least: float = 1.0, rim: float = RIM
) -> CouponWindow | None:
    return widest_window(subject("ring").surface, inner, place, widest=widest, least=least, border=BORDER, rim=rim)


@pytest.fixture(scope="module")
def place() -> CouponPlace:
    return neck_places(subject("ring").surface, subject("ring").joined)[0]


@pytest.fixture(scope="module")
def window(place: CouponPlace, inner: Floats) -> CouponWindow:
    window = found(place, inner)
    assert isinstance(window, CouponWindow)
    return window


def within(points: Floats, radius: float) -> np.ndarray:
    return np.hypot(points[:, 0], points[:, 1]) < radius


def test_the_axes_are_a_right_handed_frame_with_the_joint_along_y(window: CouponWindow) -> None:
    assert window.axes @ window.axes.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(window.axes) == pytest.approx(1.0)
    across, along, _ = window.axes @ window.place.along
    assert across == pytest.approx(0.0, abs=1e-9)
    assert along > 0.0


def test_the_place_is_seen_in_the_middle_as_deep_as_the_back(window: CouponWindow) -> None:
    assert window.seen(window.place.at[None]) == pytest.approx(np.array([[0.0, 0.0, window.depth]]))


def test_no_inner_side_reaches_above_the_back_and_none_of_the_rim_is_thin(window: CouponWindow, inner: Floats) -> None:
    reach = window.radius + BORDER
    outer, below = window.seen(subject("ring").surface.points), window.seen(inner)
    local = np.linalg.norm(subject("ring").surface.points - window.place.at, axis=1) < 2 * reach
    assert below[local & within(below, reach), 2].max() < 0.0
    assert outer[local & within(outer, reach), 2].min() >= RIM
    assert outer[local & within(outer, reach), 2].max() <= window.height < 1.2 * THICKNESS


def test_the_next_wider_one_would_not_do(place: CouponPlace, inner: Floats, window: CouponWindow) -> None:
    assert window.radius < 6.0
    wider = window.radius + 5.0 / 7.0
    assert found(place, inner, widest=wider, least=wider) is None
    assert found(place, inner, widest=window.radius, least=window.radius) is not None


def test_there_is_none_where_the_rim_would_have_to_be_higher_than_the_wall(place: CouponPlace, inner: Floats) -> None:
    assert found(place, inner, rim=2.5) is None


def test_there_is_none_where_another_wall_comes_in(place: CouponPlace, inner: Floats, window: CouponWindow) -> None:
    # a far point of the inner side is brought into the window
    far = int(np.linalg.norm(subject("ring").surface.points - place.at, axis=1).argmax())
    brought = np.array(inner)
    brought[far] = place.at - 0.5 * window.depth * window.axes[2]
    assert found(place, brought) is None


def test_there_is_none_where_the_surface_does_not_face_one_way(place: CouponPlace, inner: Floats) -> None:
    assert found(replace(place, along=np.zeros(3)), inner) is None
    assert found(place, inner, widest=40.0, least=40.0) is None
