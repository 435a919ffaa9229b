"""Line drawings: in true size, the right way round, and without what the body hides."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
import trimesh

from fabricate.picture.line_drawing import VIEWS, LineDrawing, View, line_drawing

RADIUS = 20.0
BALL = trimesh.creation.icosphere(subdivisions=5, radius=RADIUS)
BAR = trimesh.creation.box((60, 10, 10)).apply_translation((0, -40, 0))
ANGLE = np.linspace(0, 2 * np.pi, 240, endpoint=False)


def tilted(angle: float) -> np.ndarray:
    """A great circle of the ball, tilted about the x axis out of the plane of x and y."""
    flat = np.stack([np.cos(ANGLE), np.sin(ANGLE) * np.cos(angle), np.sin(ANGLE) * np.sin(angle)], axis=1)
    return RADIUS * flat


def drawn(curve: np.ndarray, view: View, *meshes: trimesh.Trimesh) -> LineDrawing:
    body = trimesh.util.concatenate([BALL, *meshes])
    return line_drawing(curve[None], curve[None] / RADIUS, np.asarray(body.vertices), np.asarray(body.faces), view)


def length(strokes: tuple[np.ndarray, ...]) -> float:
    return float(sum(np.linalg.norm(np.diff(stroke, axis=0), axis=1).sum() for stroke in strokes))


def all_points(drawing: LineDrawing) -> np.ndarray:
    return np.concatenate(drawing.visible + drawing.hidden)


@pytest.mark.parametrize("view", VIEWS)
def test_right_and_up_are_as_the_eye_sees_them(view: View) -> None:
    """A mark near the end of an axis is seen from that side only, and lies in its middle."""
    right, up = np.array(VIEWS[view], dtype=float)
    eye = np.cross(right, up)
    expected = {"front": (0, -1, 0), "back": (0, 1, 0), "left": (-1, 0, 0), "right": (1, 0, 0)}
    assert tuple(eye) == {**expected, "top": (0, 0, 1), "bottom": (0, 0, -1)}[view]
    small = RADIUS * (eye + 0.1 * np.outer(np.cos(ANGLE), right) + 0.2 * np.outer(np.sin(ANGLE), up))
    small *= RADIUS / np.linalg.norm(small, axis=1, keepdims=True)
    small = np.where((np.pi / 8 > ANGLE)[:, None], small + 2 * right, small)
    small *= RADIUS / np.linalg.norm(small, axis=1, keepdims=True)
    drawing = drawn(small, view)
    assert drawing.hidden == ()
    (stroke,) = drawing.visible
    offset = stroke[:-1] - RADIUS
    assert np.ptp(offset[:, 1]) > 1.5 * 2 * 0.1 * RADIUS
    assert offset[:, 0].max() > 0.15 * RADIUS  # the bump points right
    opposite = {"front": "back", "back": "front", "left": "right", "right": "left", "top": "bottom", "bottom": "top"}
    assert drawn(small, opposite[view]).visible == ()  # type: ignore[arg-type]


def test_the_size_is_that_of_the_body() -> None:
    drawing = drawn(tilted(1.0), "front", BAR)
    assert (drawing.width, drawing.height) == pytest.approx((60, 40), abs=0.01)
    x, y = all_points(drawing).T
    assert (x.min(), x.max()) == pytest.approx((10, 50), abs=0.1)
    assert 0 <= y.min() < y.max() <= 40


@pytest.mark.parametrize("angle", [0.6, 1.0, 1.4])
def test_half_of_a_great_circle_is_hidden(angle: float) -> None:
    curve = tilted(angle)
    drawing = drawn(curve, "top")
    assert (len(drawing.visible), len(drawing.hidden)) == (1, 1)
    assert length(drawing.visible) == pytest.approx(length(drawing.hidden), rel=0.04)
    whole = np.linalg.norm(np.diff(np.vstack([curve, curve[:1]])[:, :2], axis=0), axis=1).sum()
    assert length(drawing.visible) + length(drawing.hidden) == pytest.approx(whole, rel=1e-3)


def test_what_stands_before_the_curve_hides_it() -> None:
    curve = tilted(np.pi / 2)  # upright, facing the front edge-on: seen from the side of the bar
    turned = curve[:, [1, 0, 2]]
    free, covered = drawn(turned, "front"), drawn(turned, "front", BAR)
    assert len(free.visible) == 1
    assert len(covered.visible) == 2
    assert length(free.visible) - length(covered.visible) == pytest.approx(10, abs=0.5)


def test_strokes_join_end_to_end_along_the_curve() -> None:
    drawing = drawn(tilted(1.0), "front", BAR)
    ends = sorted(tuple(stroke[k]) for stroke in drawing.visible + drawing.hidden for k in (0, -1))
    assert len(ends) >= 4
    assert all(one == other for one, other in list(pairwise(ends))[::2])


def test_a_curve_in_full_sight_is_one_closed_stroke_of_its_own_points() -> None:
    low = tilted(0.0) * 0.5 + [0, 0, 0]
    low[:, 2] = np.sqrt(RADIUS**2 - (low[:, :2] ** 2).sum(axis=1))
    (stroke,) = drawn(low, "top").visible
    assert len(stroke) == len(low) + 1
    assert np.array_equal(stroke[0], stroke[-1])
    assert np.abs(stroke[:-1] - (low[:, :2] * [1, -1] + RADIUS)).max() < 0.02
