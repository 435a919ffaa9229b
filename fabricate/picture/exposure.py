"""One scene through one window: parts with smooth edges, and their shadow on the floor, as layers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.picture.blocks import in_blocks
from fabricate.picture.camera import Camera
from fabricate.picture.layout import Cell
from fabricate.picture.light import PATTERNS
from fabricate.picture.scene import Scene
from fabricate.picture.screen import Screen, blurred, blurred_within, dither, edges, kindred, pixel_middles
from fabricate.picture.shading import floor_shadow, plastic
from fabricate.picture.stage import FLOOR, Stage, Surfels, lit, seen, staged
from fabricate.picture.vectors import Floats32

# Rays to the sky and to the key light from each pixel, before averaging over 4 x 4 pixels (parts) or
# FLOOR_BLUR x FLOOR_BLUR (floor); and from a sample that has no neighbour to borrow light from.
PART_RAYS, FLOOR_RAYS, LONE_RAYS = (4, 2), (1, 1), (16, 8)
PART_PATTERNS = 16  # as many as pixels averaged: the same directions everywhere, hence no grain
FLOOR_BLUR = 16  # pixels: the side of the square that has every light direction
# Four samples on a turned grid (no two in one row or column), in pixels from the pixel's middle.
SUBPIXELS = np.array([(-0.125, -0.375), (0.375, -0.125), (0.125, 0.375), (-0.375, 0.125)])


@dataclass(frozen=True, eq=False)
class Exposure:
    """Layers of a picture, from the floor up.

    Attributes
    ----------
    shadow : (h, w) float
        Missing share of the floor's light.
    cover : (h, w) float
        Share of each pixel that parts cover.
    colour : (h, w, 3) float
        Linear light of the parts, times `cover`.
    """

    shadow: Floats32
    cover: Floats32
    colour: Floats32


def exposed(scene: Scene, camera: Camera, window: Cell, *, origin: tuple[float, float]) -> Exposure:
    """Expose a window of pixels; `origin` is the place in the picture on which the camera is centred."""
    stage = staged(scene)
    pixels = pixel_middles(window, origin=origin)
    pattern = dither(window)
    surfels = seen(stage, camera, pixels)
    footprint = float(np.linalg.norm(stage.foot - camera.eye)) / camera.focal
    screen = Screen(window.width, window.height, surfels, footprint)
    light = _part_light(stage, camera, screen, pattern)
    layer = _covering(stage, camera, surfels, light)
    rough = np.flatnonzero(edges(screen))
    layer[rough] = _edge_colours(stage, camera, screen, light, rough, pixels[rough])
    grid = layer.reshape(window.height, window.width, 4)
    return Exposure(_shadow(stage, camera, screen, pattern), grid[:, :, 3], grid[:, :, :3])


def _covering(stage: Stage, camera: Camera, surfels: Surfels, light: Floats32) -> Floats32:
    """(n, 4) float: linear light of parts, and 1 where there is one; 0 elsewhere."""
    layer = np.zeros((len(surfels.owner), 4), dtype=np.float32)
    part = np.flatnonzero(surfels.owner >= 0)
    layer[part, :3] = plastic(stage, camera, surfels[part], light[part])
    layer[part, 3] = 1
    return layer


def _part_light(stage: Stage, camera: Camera, screen: Screen, pattern: Indices) -> Floats32:
    """(n, 2) float: light on the parts that each pixel sees, without grain; 0 where there is none."""
    light = np.zeros((len(pattern), 2), dtype=np.float32)
    part = np.flatnonzero(screen.surfels.owner >= 0)
    directions = pattern[part] % PART_PATTERNS
    light[part] = lit(stage, camera, screen.surfels[part], pattern=directions, rays=PART_RAYS)
    return blurred(screen, light)


def _shadow(stage: Stage, camera: Camera, screen: Screen, pattern: Indices) -> Floats32:
    """(h, w) float: missing share of light on the floor, very soft; also a little way under the parts."""
    floor = np.flatnonzero(screen.surfels.owner == FLOOR)
    surfels = screen.surfels[floor]
    light = lit(stage, camera, surfels, pattern=pattern[floor], rays=FLOOR_RAYS)
    shadow = np.zeros(len(pattern), dtype=np.float32)
    shadow[floor] = floor_shadow(stage, camera, surfels, light)
    grid = shadow.reshape(screen.height, screen.width)
    bare = (screen.surfels.owner < 0).reshape(grid.shape)
    for _ in range(2):  # the second time rounds the square blur off
        grid = blurred_within(grid, bare, size=FLOOR_BLUR)
    return grid


def _edge_colours(
    stage: Stage, camera: Camera, screen: Screen, light: Floats32, where: Indices, pixels: Floats
) -> Floats32:
    """(n, 4) float: as `_covering`, but means of four samples within each of the (n, 2) pixels.

    A sample takes its light from the nearest pixel that sees its surface; few see one that no pixel does.
    """
    surfels = seen(stage, camera, (pixels[:, None] + SUBPIXELS).reshape(-1, 2))
    own = np.repeat(where, len(SUBPIXELS))
    kin = np.concatenate(in_blocks(lambda block: kindred(screen, own[block], surfels[block]), len(own)))
    borrowed = light[kin]
    lost = np.flatnonzero((kin < 0) & (surfels.owner >= 0))
    pattern = np.arange(len(lost)) % PATTERNS
    borrowed[lost] = lit(stage, camera, surfels[lost], pattern=pattern, rays=LONE_RAYS)
    layer = _covering(stage, camera, surfels, borrowed)
    means: Floats32 = layer.reshape(len(pixels), len(SUBPIXELS), 4).mean(axis=1)
    return means
