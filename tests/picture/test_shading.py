"""Shading: no light is black, more light is brighter, hue is the part's, an open floor has no shadow."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from fabricate.picture.camera import camera_towards
from fabricate.picture.light import key_direction
from fabricate.picture.scene import scene_of_parts
from fabricate.picture.shading import floor_shadow, plastic
from fabricate.picture.stage import FLOOR, FLOOR_REACH, Surfels, staged
from fabricate.solid.part import Part

BOX = trimesh.creation.box((2, 2, 2))
SCENE = scene_of_parts([Part("box", BOX.vertices, BOX.faces)], [(60, 120, 200)])
CAMERA = camera_towards(SCENE.points)
STAGE = staged(SCENE)


def facing(owner: int, position: np.ndarray, normal: np.ndarray, count: int = 1) -> Surfels:
    where = np.tile(position, (count, 1)).astype(np.float32)
    along = np.tile(normal, (count, 1)).astype(np.float32)
    return Surfels(np.full(count, owner), where, along, along)


def test_no_light_is_black() -> None:
    surfels = facing(0, np.zeros(3), CAMERA.axes[2])
    np.testing.assert_array_equal(plastic(STAGE, CAMERA, surfels, np.zeros((1, 2), np.float32)), 0)


@pytest.mark.parametrize("column", [0, 1])
def test_more_light_is_brighter(column: int) -> None:
    light = np.zeros((5, 2), dtype=np.float32)
    light[:, column] = np.linspace(0, 1, 5)
    colours = plastic(STAGE, CAMERA, facing(0, np.zeros(3), CAMERA.axes[2], 5), light)
    assert (np.diff(colours, axis=0) > 0).all()
    assert colours.max() <= 1


def test_the_order_of_the_channels_is_that_of_the_part() -> None:
    light = np.float32([[0.5, 0.2]])
    (colour,) = plastic(STAGE, CAMERA, facing(0, np.zeros(3), CAMERA.axes[2]), light)
    assert colour[0] < colour[1] < colour[2]


def test_shadow_is_the_missing_share_of_light_and_fades_with_distance() -> None:
    open_floor = np.float32([[1, key_direction(CAMERA)[2]]])
    dark = np.zeros((1, 2), dtype=np.float32)
    up = np.array([0.0, 0, 1])
    near = facing(FLOOR, STAGE.foot, up)
    far = facing(FLOOR, STAGE.foot + np.array([FLOOR_REACH * STAGE.radius, 0, 0]), up)
    assert floor_shadow(STAGE, CAMERA, near, open_floor)[0] == pytest.approx(0, abs=1e-6)
    assert floor_shadow(STAGE, CAMERA, near, dark)[0] == pytest.approx(1)
    assert floor_shadow(STAGE, CAMERA, near, open_floor / 2)[0] == pytest.approx(0.5, abs=1e-6)
    assert floor_shadow(STAGE, CAMERA, far, dark)[0] == pytest.approx(0, abs=1e-6)
