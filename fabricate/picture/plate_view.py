"""The picture of flat things on a build plate, seen steeply from above, so that raised letters can be read."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PIL import Image

from fabricate.picture.camera import camera_towards
from fabricate.picture.palette import part_colours
from fabricate.picture.render import render
from fabricate.picture.scene import scene_of_parts
from fabricate.solid.part import Part

STEEP_VIEW = (0.0, -0.45, 0.9)
MARGIN = 0.06
"""Of the picture's width, on each side."""


def plate_image(parts: Sequence[Part], *, width: int = 1200) -> Image.Image:
    """Return a picture of parts where they lie, each in its own colour, `width` pixels wide.

    Raises
    ------
    ValueError
        If there are no parts.
    """
    if not parts:
        raise ValueError("expected at least one part, found none")
    points = np.concatenate([part.points for part in parts])
    camera = camera_towards(points, direction=STEEP_VIEW)
    across, high = camera.extent(points)
    camera = camera.magnified((1.0 - 2.0 * MARGIN) * width / across)
    height = max(round((1.0 - 2.0 * MARGIN) * width * high / across + 2.0 * MARGIN * width), 1)
    scene = scene_of_parts([_faceted(part) for part in parts], part_colours([part.name for part in parts]))
    return Image.fromarray(render(scene, camera, width=width, height=height))


def _faceted(part: Part) -> Part:
    """Return a part whose triangles share no points, so that each is shaded flat: large ones beside letters are."""
    return Part(
        part.name, part.points[part.triangles].reshape(-1, 3), np.arange(3 * len(part.triangles)).reshape(-1, 3)
    )
