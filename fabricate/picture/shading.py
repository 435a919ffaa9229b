"""From light that arrives to the colour that is seen: satin plastic on a white floor."""

from __future__ import annotations

import numpy as np

from fabricate.picture.camera import Camera
from fabricate.picture.light import key_direction
from fabricate.picture.stage import FLOOR_REACH, Stage, Surfels
from fabricate.picture.vectors import Floats32, dots, smooth_step, unit

SKY_POWER, KEY_POWER = 0.66, 0.56
GLOSS, GLOSS_EXPONENT = 0.22, 40
SHEEN = 0.30  # of the sky, at grazing angles


def plastic(stage: Stage, camera: Camera, surfels: Surfels, light: Floats32) -> Floats32:
    """(n, 3) float: linear light, 0..1, from spots of parts: matt colour, soft highlight, sheen at the rim.

    `light` (n, 2) is what arrives from the sky and from the key light.
    """
    sky, direct = light.T
    albedo = stage.colours[surfels.owner]
    views = unit(camera.eye.astype(np.float32) - surfels.positions)
    halfway = unit(views + key_direction(camera))
    matt = albedo * (SKY_POWER * _with_bounces(sky, albedo) + KEY_POWER * direct[:, None])
    highlight = GLOSS * direct * np.maximum(dots(surfels.normals, halfway), 0) ** GLOSS_EXPONENT
    rim = SHEEN * sky * (1 - np.clip(dots(surfels.normals, views), 0, 1)) ** 5
    colours: Floats32 = np.clip(matt + (highlight + rim)[:, None], 0, 1)
    return colours


def floor_shadow(stage: Stage, camera: Camera, surfels: Surfels, light: Floats32) -> Floats32:
    """(n,) float: missing share, 0..1, of the light on spots of the floor; none where its reach ends."""
    away = np.hypot(*(surfels.positions[:, :2] - stage.foot[:2].astype(np.float32)).T)
    power = np.array([SKY_POWER, KEY_POWER], dtype=np.float32)
    full = power @ np.array([1, key_direction(camera)[2]], dtype=np.float32)
    missing: Floats32 = np.clip(1 - light @ power / full, 0, 1)
    return missing * smooth_step(2 * (1 - away / np.float32(FLOOR_REACH * stage.radius)))


def _with_bounces(sky: Floats32, albedo: Floats32) -> Floats32:
    """(n, 3) float: sky light together with what walls of the same colour throw at each other.

    Cubic fit of J. Jimenez et al., "Practical Real-Time Strategies for Accurate Indirect Occlusion", 2016.
    """
    a, b, c = 2.0404 * albedo - 0.3324, -4.7951 * albedo + 0.6417, 2.7552 * albedo + 0.6903
    x = np.minimum(sky, 1)[:, None]
    bounced: Floats32 = np.maximum(sky[:, None], ((x * a + b) * x + c) * x)
    return bounced
