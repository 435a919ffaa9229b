"""Exposures: how much of the picture a body covers, and where its shadow falls."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from shapely.geometry import MultiPoint

from fabricate.picture.camera import camera_towards
from fabricate.picture.exposure import Exposure, exposed
from fabricate.picture.layout import Cell
from fabricate.picture.light import key_direction
from fabricate.picture.scene import Scene, scene_of_parts
from fabricate.solid.part import Part

WINDOW = Cell(0, 0, 160, 120)


def scene(mesh: trimesh.Trimesh) -> Scene:
    return scene_of_parts([Part("yellow", mesh.vertices, mesh.faces)], [(240, 180, 40)])


BOX = scene(trimesh.creation.box((30, 20, 25)))
CAMERA = camera_towards(BOX.points).magnified(400)


def box_exposure() -> Exposure:
    return exposed(BOX, CAMERA, WINDOW, origin=WINDOW.middle)


def test_a_box_covers_as_many_pixels_as_its_outline_encloses() -> None:
    outline = MultiPoint(CAMERA.pixels(BOX.points)).convex_hull
    assert box_exposure().cover.sum() == pytest.approx(outline.area, rel=0.005)


def test_edges_are_smooth_and_colour_is_only_where_parts_are() -> None:
    exposure = box_exposure()
    partly = (exposure.cover > 0) & (exposure.cover < 1)
    assert 50 < partly.sum() < 1000
    assert not exposure.colour[exposure.cover == 0].any()
    assert (exposure.colour <= exposure.cover[:, :, None] + 1e-6).all()


def test_shadow_is_darker_on_the_side_away_from_the_key_light() -> None:
    shadow = box_exposure().shadow
    low = BOX.points.min(axis=0)[2]
    away = -key_direction(CAMERA)[:2] / np.linalg.norm(key_direction(CAMERA)[:2]) * 19
    behind, before = np.array([[*away, low], [*-away, low]])
    x, y = (CAMERA.pixels(np.stack([behind, before])) + WINDOW.middle).astype(int).T
    assert shadow[y[0], x[0]] > shadow[y[1], x[1]] + 0.1


def test_a_part_of_a_window_is_the_same_as_that_part_of_the_whole() -> None:
    window = Cell(16, 32, 96, 64)
    part = exposed(BOX, CAMERA, window, origin=WINDOW.middle)
    whole = box_exposure()
    inner = slice(4, -4), slice(4, -4)
    np.testing.assert_allclose(part.cover[inner], whole.cover[window.rows, window.columns][inner], atol=1e-6)
    np.testing.assert_allclose(part.colour[inner], whole.colour[window.rows, window.columns][inner], atol=1e-4)


def test_a_wire_thinner_than_a_pixel_is_still_seen() -> None:
    wire = scene(trimesh.creation.cylinder(0.1, 30, sections=8))
    width, height = CAMERA.extent(wire.points)
    assert width < 0.7
    exposure = exposed(wire, CAMERA, WINDOW, origin=WINDOW.middle)
    assert exposure.cover.sum() == pytest.approx(width * height, rel=0.25)


def test_a_window_of_one_pixel_works() -> None:
    exposure = exposed(BOX, CAMERA, Cell(80, 60, 1, 1), origin=WINDOW.middle)
    assert exposure.cover.tolist() == [[1.0]]
