"""What is photographed: triangles with a colour each, and the normals they are shaded with."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices, frozen
from fabricate.picture.palette import Colour
from fabricate.picture.vectors import Floats32, dots, unit
from fabricate.solid.part import Part


@dataclass(frozen=True, eq=False)
class Scene:
    """Coloured triangles, counter-clockwise seen from outside.

    Attributes
    ----------
    points : (n, 3) float
        mm.
    triangles : (m, 3) int
        Indices into `points`.
    colours : (k, 3) float
        sRGB, 0..1.
    colour_of : (m,) int
        Index into `colours` of each triangle.
    """

    points: Floats
    triangles: Indices
    colours: Floats
    colour_of: Indices

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen(self.points, np.float64, (None, 3)))
        object.__setattr__(self, "triangles", frozen(self.triangles, np.int64, (None, 3)))
        object.__setattr__(self, "colours", frozen(self.colours, np.float64, (None, 3)))
        object.__setattr__(self, "colour_of", frozen(self.colour_of, np.int64, (len(self.triangles),)))


def scene_of_parts(parts: Sequence[Part], colours: Sequence[Colour]) -> Scene:
    """Return the parts as they are seated, each in its own sRGB colour (0..255)."""
    starts = np.cumsum([0] + [len(part.points) for part in parts])
    return Scene(
        np.concatenate([part.points for part in parts]),
        np.concatenate([part.triangles + start for part, start in zip(parts, starts, strict=False)]),
        np.asarray(colours) / 255.0,
        np.repeat(np.arange(len(parts)), [len(part.triangles) for part in parts]),
    )


def facet_normals(scene: Scene) -> Floats32:
    """(m, 3) float: outward unit normal of each triangle; zero where it has no area."""
    a, b, c = scene.points[scene.triangles.T]
    return unit(np.cross(b - a, c - a))


def corner_normals(scene: Scene, facets: Floats32, *, crease: float) -> Floats32:
    """(m, 3, 3) float: unit normal at each triangle corner, smooth except across creases.

    A corner takes the mean normal of all triangles round its point, weighted by their angles there
    (not by area: that would tilt a narrow side towards a wide one), unless this is more than `crease`
    degrees away from the triangle's own normal. `facets` are those of `facet_normals`.
    """
    corners = scene.triangles.ravel()
    angles = _corner_angles(scene)
    sums = [np.bincount(corners, (angles * facets[:, axis, None]).ravel(), len(scene.points)) for axis in range(3)]
    smooth = unit(np.stack(sums, axis=1))[scene.triangles]
    near = np.einsum("mcx,mx->mc", smooth, facets) >= np.cos(np.radians(crease))
    return np.where(near[:, :, None], smooth, facets[:, None, :])


def _corner_angles(scene: Scene) -> Floats32:
    """(m, 3) float: radians."""
    corners = scene.points[scene.triangles.T]
    edges = [unit(corners[(k + 1) % 3] - corners[k]) for k in range(3)]
    cosines = np.stack([-dots(edges[k], edges[k - 1]) for k in range(3)], axis=1)
    return np.arccos(np.clip(cosines, -1, 1))
