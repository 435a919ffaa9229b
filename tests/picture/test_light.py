"""Light: directions are spread as they should be, and walls take away what geometry says."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from fabricate.picture.camera import camera_towards
from fabricate.picture.light import (
    KEY_SPREAD,
    PATTERNS,
    key_direction,
    key_directions,
    key_light,
    sky_directions,
    sky_light,
    sky_radiance,
)
from fabricate.picture.ray_caster import RayCaster

CAMERA = camera_towards(np.array([[-1.0, -1, -1], [1, 1, 1]]))
UP = np.tile(np.float32([0, 0, 1]), (PATTERNS, 1))
ORIGIN = np.zeros((PATTERNS, 3), dtype=np.float32)
EVERY = np.arange(PATTERNS)


def caster(*corners: tuple[float, float, float]) -> RayCaster:
    """One quad of four corners."""
    return RayCaster(np.array(corners), np.array([[0, 1, 2], [0, 2, 3]]))


FAR_BELOW = caster((-1, -1, -90), (1, -1, -90), (1, 1, -90), (-1, 1, -90))


def test_sky_directions_follow_the_cosine_law() -> None:
    directions = sky_directions(4, EVERY).reshape(-1, 3)
    np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1, atol=1e-6)
    assert directions[:, 2].min() >= 0
    # Means under the density cos(angle) / pi: z has 2/3, x and y have 0, x^2 has 1/4.
    np.testing.assert_allclose(directions.mean(axis=0), [0, 0, 2 / 3], atol=0.005)
    assert (directions[:, 0] ** 2).mean() == pytest.approx(1 / 4, abs=0.005)


@pytest.mark.parametrize("first", range(0, PATTERNS, 16))
def test_sixteen_successive_patterns_are_spread_evenly_too(first: int) -> None:
    directions = sky_directions(4, np.arange(first, first + 16)).reshape(-1, 3)
    np.testing.assert_allclose(directions.mean(axis=0), [0, 0, 2 / 3], atol=0.05)


def test_key_directions_fill_a_disc_round_the_key_light() -> None:
    directions = key_directions(CAMERA, 2, EVERY).reshape(-1, 3)
    angles = np.arccos(np.clip(directions @ key_direction(CAMERA), -1, 1))
    assert angles.max() <= np.arctan(KEY_SPREAD) + 1e-3
    assert angles.max() >= 0.9 * np.arctan(KEY_SPREAD)
    assert np.degrees(np.arccos(unit_mean(directions) @ key_direction(CAMERA))) < 0.5


def unit_mean(vectors: np.ndarray) -> np.ndarray:
    mean = vectors.mean(axis=0)
    return mean / np.linalg.norm(mean)


def test_the_open_sky_has_the_brightness_of_its_integral() -> None:
    light = sky_light(FAR_BELOW, ORIGIN, UP, UP, sky_directions(4, EVERY))
    # The mean of 0.66 + z / 2 under the cosine law.
    assert light.mean() == pytest.approx(0.66 + 0.5 * 2 / 3, abs=0.005)


def test_a_wall_takes_away_half_of_the_sky() -> None:
    wall = caster((0.01, -900, -900), (0.01, 900, -900), (0.01, 900, 900), (0.01, -900, 900))
    open_sky = sky_light(FAR_BELOW, ORIGIN, UP, UP, sky_directions(4, EVERY)).mean()
    assert sky_light(wall, ORIGIN, UP, UP, sky_directions(4, EVERY)).mean() == pytest.approx(open_sky / 2, rel=0.02)


def test_there_is_no_light_in_a_closed_box() -> None:
    box = trimesh.creation.box((2, 2, 2))
    inside = RayCaster(box.vertices, box.faces)
    assert not sky_light(inside, ORIGIN, UP, UP, sky_directions(4, EVERY)).any()
    assert not key_light(inside, ORIGIN, UP, UP, key_directions(CAMERA, 1, EVERY)).any()


def test_key_light_falls_with_the_cosine_and_ends_behind_the_surface() -> None:
    towards = np.tile(key_direction(CAMERA), (3, 1))
    side = np.cross(towards[0], [0, 0, 1])
    normals = np.stack([towards[0], unit_mean(np.stack([towards[0], side])), -towards[0]]).astype(np.float32)
    light = key_light(FAR_BELOW, ORIGIN[:3], normals, normals, towards[None])
    expected = [1, normals[1] @ towards[0], 0]
    np.testing.assert_allclose(light, expected, atol=1e-6)


def test_rays_stay_above_the_triangle_where_the_smoothed_normal_leans_away() -> None:
    lean = np.tile(np.float32([0.8, 0, 0.6]), (PATTERNS, 1))
    ground = caster((-99, -99, -0.001), (99, -99, -0.001), (99, 99, -0.001), (-99, 99, -0.001))
    light = sky_light(ground, ORIGIN, lean, UP, sky_directions(4, EVERY))
    assert light.min() > sky_radiance(np.float32([0.0]))[0]
