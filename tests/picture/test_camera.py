"""The camera: rays and pixels are inverse, the subject is centred, up is up."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.picture.camera import camera_towards

CUBE = np.stack(np.meshgrid([-1.0, 1], [-1, 1], [-1, 1]), axis=-1).reshape(-1, 3) * 20 + [5, 6, 7]
CAMERA = camera_towards(CUBE).magnified(500)

coordinates = st.floats(-30, 30)


@given(st.tuples(coordinates, coordinates, coordinates))
def test_the_ray_through_the_pixel_of_a_point_meets_the_point(point: tuple[float, float, float]) -> None:
    (direction,) = CAMERA.directions(CAMERA.pixels(np.array([point])))
    towards = np.array(point) - CAMERA.eye
    np.testing.assert_allclose(direction, towards / np.linalg.norm(towards), atol=1e-12)


def test_axes_are_orthonormal_and_right_handed() -> None:
    np.testing.assert_allclose(CAMERA.axes @ CAMERA.axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(CAMERA.axes) == pytest.approx(1)


def test_the_subject_is_centred() -> None:
    pixels = CAMERA.pixels(CUBE)
    np.testing.assert_allclose(pixels.min(axis=0), -pixels.max(axis=0), atol=1e-9)


def test_higher_points_are_seen_higher_in_the_picture() -> None:
    low, high = CAMERA.pixels(np.array([[5.0, 6, 0], [5, 6, 10]]))
    assert high[1] < low[1]
    assert high[0] == pytest.approx(low[0], abs=1.0)


def test_magnified_is_the_same_view_but_larger() -> None:
    np.testing.assert_allclose(CAMERA.magnified(3).pixels(CUBE), 3 * CAMERA.pixels(CUBE))
    np.testing.assert_allclose(CAMERA.magnified(3).extent(CUBE), 3 * np.array(CAMERA.extent(CUBE)))


@pytest.mark.parametrize("direction", [(1, 0, 0), (0, -1, 0.2), (-1, 2, -0.5)])
def test_the_eye_is_in_the_direction_asked_for(direction: tuple[float, float, float]) -> None:
    camera = camera_towards(CUBE, direction=direction)
    assert np.dot(camera.axes[2], direction) == pytest.approx(np.linalg.norm(direction))
    away = camera.eye - [5, 6, 7]
    np.testing.assert_allclose(np.cross(away, direction), 0, atol=1e-9)


def test_nobody_can_move_the_camera() -> None:
    with pytest.raises(ValueError, match="read-only"):
        CAMERA.eye[0] = 0
