"""From scenes and cameras to a finished picture."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fabricate.picture.camera import Camera
from fabricate.picture.exposure import Exposure, exposed
from fabricate.picture.layout import Cell
from fabricate.picture.palette import encoded_light, linear_light
from fabricate.picture.scene import Scene

BACKGROUND = (0.957, 0.953, 0.945)  # sRGB; also the floor where nothing shades it


def render(scene: Scene, camera: Camera, *, width: int, height: int) -> NDArray[np.uint8]:
    """Return a picture of the scene on a white floor, the camera's centre in its middle.

    Returns
    -------
    (height, width, 3) uint8
        sRGB. The same scene gives the same picture on any number of cores.
    """
    window = Cell(0, 0, width, height)
    return developed(window, [(window, exposed(scene, camera, window, origin=window.middle))])


def developed(picture: Cell, exposures: Sequence[tuple[Cell, Exposure]]) -> NDArray[np.uint8]:
    """Return one picture of several exposures, each in its own window; windows may overlap.

    Their shadows fall together on one floor; then the parts are laid over it, in order.

    Returns
    -------
    (height, width, 3) uint8
        sRGB.
    """
    shape = picture.height, picture.width, 3
    light = np.broadcast_to(linear_light(BACKGROUND).astype(np.float32), shape).copy()
    for window, exposure in exposures:
        light[window.rows, window.columns] *= 1 - exposure.shadow[:, :, None]
    for window, exposure in exposures:
        below = light[window.rows, window.columns]
        light[window.rows, window.columns] = exposure.colour + (1 - exposure.cover[:, :, None]) * below
    return np.round(encoded_light(np.clip(light, 0, 1)) * 255).astype(np.uint8)
