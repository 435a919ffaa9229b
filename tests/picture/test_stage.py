"""What rays see: the nearer part, spots on the true surface, the floor, nothing."""

from __future__ import annotations

import numpy as np
import trimesh

from fabricate.picture.camera import camera_towards
from fabricate.picture.scene import Scene, scene_of_parts
from fabricate.picture.stage import FLOOR, FLOOR_REACH, NOTHING, lit, seen, staged
from fabricate.solid.part import Part

RADIUS = 10.0
BALL = trimesh.creation.icosphere(subdivisions=5, radius=RADIUS)
SCENE = scene_of_parts([Part("ball", BALL.vertices, BALL.faces)], [(200, 100, 50)])
CAMERA = camera_towards(SCENE.points).magnified(600)
GRID = np.stack(np.meshgrid(np.linspace(-250, 250, 60), np.linspace(-250, 250, 60)), axis=-1).reshape(-1, 2)


def test_spots_of_a_ball_are_on_the_ball_and_face_the_eye() -> None:
    surfels = seen(staged(SCENE), CAMERA, GRID)
    ball = surfels.owner == 0
    assert ball.any()
    distance = np.linalg.norm(surfels.positions[ball], axis=1)
    np.testing.assert_allclose(distance, RADIUS, rtol=2e-3)
    np.testing.assert_allclose(surfels.normals[ball], surfels.positions[ball] / RADIUS, atol=0.01)
    views = CAMERA.eye - surfels.positions[ball]
    assert (np.einsum("nx,nx->n", surfels.facets[ball], views) >= 0).all()


def test_the_floor_is_under_the_ball_and_ends_at_its_reach() -> None:
    stage = staged(SCENE)
    surfels = seen(stage, CAMERA, GRID)
    floor = surfels.positions[surfels.owner == FLOOR]
    np.testing.assert_allclose(floor[:, 2], -RADIUS, atol=1e-3)
    away = np.linalg.norm(floor[:, :2], axis=1)
    assert 0.95 < away.max() / (FLOOR_REACH * stage.radius) <= 1.001
    assert (surfels.owner == NOTHING).any()


def test_the_nearer_of_two_parts_is_seen() -> None:
    towards_eye = CAMERA.axes[2]
    near = Part("near", BALL.vertices / 2 + 3 * RADIUS * towards_eye, BALL.faces)
    far = Part("far", BALL.vertices, BALL.faces)
    middle = np.zeros((1, 2))
    for parts, first in (([far, near], 1), ([near, far], 0)):
        stage = staged(scene_of_parts(parts, [(9, 9, 9), (99, 99, 99)]))
        assert seen(stage, CAMERA, middle).owner.tolist() == [first]


def test_a_triangle_seen_from_behind_is_turned_to_the_eye() -> None:
    back = Scene(SCENE.points, SCENE.triangles[:, ::-1], SCENE.colours, SCENE.colour_of)
    front, turned = (seen(staged(scene), CAMERA, GRID) for scene in (SCENE, back))
    ball = front.owner == 0
    np.testing.assert_allclose(turned.normals[ball], front.normals[ball], atol=1e-4)


def test_light_falls_from_above() -> None:
    stage = staged(SCENE)
    surfels = seen(stage, CAMERA, GRID)
    ball = surfels[np.flatnonzero(surfels.owner == 0)]
    sky, key = lit(stage, CAMERA, ball, pattern=np.arange(len(ball.owner)) % 256, rays=(8, 4)).T
    height = ball.normals[:, 2]
    assert sky[height > 0.7].mean() > 1.3 * sky[height < -0.3].mean()
    assert key[height > 0.7].mean() > 0.5
    assert key.min() == 0


def test_the_floor_is_dark_where_the_ball_stands() -> None:
    stage = staged(SCENE)
    surfels = seen(stage, CAMERA, 2 * GRID)
    floor = surfels[np.flatnonzero(surfels.owner == FLOOR)]
    sky = lit(stage, CAMERA, floor, pattern=np.arange(len(floor.owner)) % 256, rays=(8, 4))[:, 0]
    away = np.linalg.norm(floor.positions[:, :2], axis=1)
    assert sky[away < 0.8 * RADIUS].mean() < 0.6 * sky[away > 2 * RADIUS].mean()
