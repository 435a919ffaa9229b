"""Pictures of known things: silhouettes, colours, background; the same every time on any number of cores."""

from __future__ import annotations

import os

import numpy as np
import pytest
import trimesh

from fabricate.picture.camera import camera_towards
from fabricate.picture.exposure import Exposure
from fabricate.picture.layout import Cell
from fabricate.picture.render import BACKGROUND, developed, render
from fabricate.picture.scene import Scene, scene_of_parts
from fabricate.solid.part import Part

RADIUS = 10.0
BALL = trimesh.creation.icosphere(subdivisions=5, radius=RADIUS)
BLUE, YELLOW = (40, 100, 200), (240, 180, 40)


def ball(colour: tuple[int, int, int] = BLUE) -> Scene:
    return scene_of_parts([Part("ball", BALL.vertices, BALL.faces)], [colour])


CAMERA = camera_towards(ball().points).magnified(600)


def bluish(picture: np.ndarray) -> np.ndarray:
    return picture[:, :, 2].astype(int) - picture[:, :, 0] > 25


def test_the_silhouette_of_a_ball_has_the_area_of_its_tangent_cone() -> None:
    picture = render(ball(), CAMERA, width=260, height=240)
    distance = float(np.linalg.norm(CAMERA.eye))
    radius = CAMERA.focal * RADIUS / np.sqrt(distance**2 - RADIUS**2)
    assert bluish(picture).sum() == pytest.approx(np.pi * radius**2, rel=0.02)


def test_far_from_everything_is_the_background() -> None:
    picture = render(ball(), CAMERA, width=600, height=240)
    assert picture.shape == (240, 600, 3)
    assert picture.dtype == np.uint8
    np.testing.assert_allclose(picture[:40, :60] / 255, np.broadcast_to(BACKGROUND, (40, 60, 3)), atol=0.01)


@pytest.mark.parametrize("nearer", [0, 1])
def test_the_nearer_of_two_planes_is_seen(nearer: int) -> None:
    plane = trimesh.creation.box((60, 1, 60))
    parts = [Part(str(k), plane.vertices - [0, 20.0 * (k == nearer), 0], plane.faces) for k in range(2)]
    scene = scene_of_parts(parts, [BLUE, YELLOW])
    camera = camera_towards(scene.points, direction=(0, -1, 0.1)).magnified(200)
    picture = render(scene, camera, width=40, height=40)
    assert bluish(picture).all() if nearer == 0 else not bluish(picture).any()


def test_the_side_towards_the_key_light_is_brighter() -> None:
    picture = render(ball(YELLOW), CAMERA, width=240, height=240).astype(int).sum(axis=2)
    assert picture[80, 85] > 1.15 * picture[160, 155]


def test_the_same_scene_gives_the_same_picture_on_any_number_of_cores(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    pictures = []
    for cores in (1, 1, 4):
        monkeypatch.setattr(os, "cpu_count", lambda cores=cores: cores)
        pictures.append(render(ball(), CAMERA, width=200, height=150).tobytes())
    assert pictures[0] == pictures[1] == pictures[2]


def test_shadows_multiply_on_one_floor_and_parts_lie_on_top() -> None:
    one = np.ones((2, 2), dtype=np.float32)
    blank = np.zeros((2, 2, 3), dtype=np.float32)
    shade = Exposure(one * 0.5, one * 0, blank)
    cover = Exposure(one * 0, one * np.float32([[1, 0], [0, 0]]), blank)
    picture = Cell(0, 0, 3, 2)
    bare = developed(picture, [])
    twice = developed(picture, [(Cell(0, 0, 2, 2), shade), (Cell(1, 0, 2, 2), shade)])
    assert (twice[:, 1] < twice[:, 0]).all()
    np.testing.assert_array_equal(twice[:, 0], twice[:, 2])
    assert (twice[:, 0] < bare[:, 0]).all()
    covered = developed(picture, [(Cell(0, 0, 2, 2), cover), (Cell(0, 0, 2, 2), shade)])
    assert not covered[0, 0].any()
    assert covered[0, 1].any()
