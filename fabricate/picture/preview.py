"""The picture that lies beside the parts: seated together on the left, pulled apart on the right."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np
from PIL import Image

from fabricate.picture.camera import camera_towards
from fabricate.picture.exposure import exposed
from fabricate.picture.layout import layout
from fabricate.picture.palette import Colour, part_colours
from fabricate.picture.render import developed
from fabricate.picture.scene import Scene, scene_of_parts
from fabricate.solid.part import Part

MARGIN = 0.10  # of a cell's width or height, on each side
NO_MARKS: Mapping[str, Part] = MappingProxyType({})
SPREAD = 0.6  # how far shadows may reach out of a cell, in its widths and heights


def preview_image(
    parts: Sequence[Part], *, marks: Mapping[str, Part] = NO_MARKS, width: int = 1200, height: int = 600
) -> Image.Image:
    """Return a picture of the parts: seated on the left, pulled apart on the right, at one scale.

    Pulled apart, each part is seen from where it was seen in its seat, and none hides another: they
    stand in a row, or in rows one above the other where that shows them larger. The picture
    is `width` pixels wide and at most `height` high. `marks` by a part's name are shown with it where it stands alone.

    Raises
    ------
    ValueError
        If there are no parts or one of them has no triangles.
    """
    empty = [part.name for part in parts if len(part.triangles) == 0]
    if empty or not parts:
        raise ValueError(f"expected parts with triangles, found {len(parts)} parts, without triangles: {empty}")
    points = np.concatenate([part.points for part in parts])
    camera = camera_towards(points)
    plan = layout(len(parts), width=width, height=height, subject=camera.extent(points), margin=MARGIN)
    camera = camera.magnified(plan.scale)
    colours = part_colours([part.name for part in parts])
    scenes = [
        scene_of_parts(parts, colours),
        *(_alone(part, colour, marks) for part, colour in zip(parts, colours, strict=True)),
    ]
    windows = [cell.grown(SPREAD, within=plan.picture) for cell in plan.cells]
    exposures = [
        exposed(scene, camera, window, origin=cell.middle)
        for scene, window, cell in zip(scenes, windows, plan.cells, strict=True)
    ]
    return Image.fromarray(developed(plan.picture, list(zip(windows, exposures, strict=True))))


def _alone(part: Part, colour: Colour, marks: Mapping[str, Part]) -> Scene:
    """Return a part with its marks."""
    own = [marks[part.name]] if part.name in marks else []
    return scene_of_parts([part, *own], [colour, *part_colours([mark.name for mark in own])])
