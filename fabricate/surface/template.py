r"""Tile templates: triangulations of the unit square that conform to the two arcs of a tile.

A template is made once for an arc position r and a resolution n; every tile is a copy of it. The square has y0 at
(0, 0), b1 at (1, 0), y2 at (1, 1), b3 at (0, 1). A yellow-joined tile is two fans of rays, from the blue corners
b1 and b3 to the yellow diagonal between them:

    b3 ______t____ y2
     |      /    .|       ray i leaves b1, crosses the arc at A(i), and ends on the diagonal at
     |    _/   .  |       E(i), with E(0) = y0 and E(n) = y2; the fan from b3 is the same, turned
     |___/   .   _t       by half a turn, and ends on the same points
     t     .   _/ |
     |   .    /   |       t marks where the curve crosses a side: rays 0 and n run along the sides
     |_._____t____|
    y0             b1

Every ray has m = `radial(n)` steps on either side of the arc. The curve can be moved along its rays without
folding the triangulation: that is how clearance is made.

Sides have 2 m segments, m on either side of the crossing, counted from the yellow end, so neighbouring tiles
place the same points. A blue-joined tile is the same construction a quarter turn on, with 1 - r for r.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices, Mask, frozen
from fabricate.errors import PatternError

ARC_MIN, ARC_MAX = 1.0 - float(np.sqrt(0.5)), float(np.sqrt(0.5))
"""Outside of these arc positions the two arcs of a tile meet."""


@dataclass(frozen=True, eq=False)
class TileTemplate:
    """A triangulated unit square whose edges include the two arcs of a tile.

    Samples are ordered: 4 corners; 2 m - 1 on each of the sides 0 to 3, from the side's yellow end;
    then the interior ones.

    Attributes
    ----------
    uv : (s, 2) float
        Position of each sample in the square.
    triangles : (t, 3) int
        Counter-clockwise in the square.
    yellow : (t,) bool
        Colour of each triangle.
    rays : (2, n + 1, 2 m + 1) int
        Samples along the rays that cross the arc entering through side 0 and the one entering through
        side 2, in the direction of the curve with yellow on its left; each ray from its blue to its
        yellow end, with the arc in the middle.
    """

    uv: Floats
    triangles: Indices
    yellow: Mask
    rays: Indices

    def __post_init__(self) -> None:
        object.__setattr__(self, "uv", frozen(self.uv, np.float64, (None, 2)))
        object.__setattr__(self, "triangles", frozen(self.triangles, np.int64, (None, 3)))
        object.__setattr__(self, "yellow", frozen(self.yellow, np.bool_, (len(self.triangles),)))
        object.__setattr__(self, "rays", frozen(self.rays, np.int64, (2, None, None)))

    @property
    def arcs(self) -> Indices:
        """(2, n + 1) int: samples along the two arcs, yellow on the left."""
        return self.rays[:, :, self.rays.shape[2] // 2]


def radial(resolution: int) -> int:
    """Return m, the steps on a ray on either side of the arc, for n segments along it.

    Rays are nearly straight, so they need fewer points than the arcs.
    """
    return max(2, (2 * resolution + 2) // 3)


def tile_template(*, arc: float, resolution: int, yellow_joined: bool) -> TileTemplate:
    """Return the template of a yellow-joined or a blue-joined tile for arc position `arc`.

    Raises
    ------
    PatternError
        If the arc position is not between 0.293 and 0.707, or the resolution is below 2.
    """
    if not ARC_MIN < arc < ARC_MAX:
        raise PatternError(f"the arc position must lie between {ARC_MIN:.3f} and {ARC_MAX:.3f}, found {arc:g}")
    if resolution < 2:
        raise PatternError(f"a tile needs at least 2 segments per arc, found {resolution}")
    if yellow_joined:
        return _joined_template(arc, resolution)
    return _turned(_joined_template(1.0 - arc, resolution))


def side_fractions(*, arc: float, resolution: int) -> Floats:
    """Return the fractions from the yellow end at which a tile side is divided, (2 m + 1,) float."""
    steps = np.arange(radial(resolution) + 1) / radial(resolution)
    return np.concatenate([arc * steps, arc + (1.0 - arc) * steps[1:]])


def _joined_template(arc: float, n: int) -> TileTemplate:
    """Join the two fans of a yellow-joined tile at the sides and on the diagonal."""
    fan, rays = _fan(arc, n), _ray_numbers(n)
    inner = fan[1:-1, 1:-1].reshape(-1, 2)
    cells, yellow = _fan_cells(n, radial(n))
    triangles = rays.reshape(2, -1)[:, cells].reshape(-1, 3)
    uv = np.concatenate([_rim(arc, n), inner, 1.0 - inner, fan[1:-1, -1]])
    return TileTemplate(uv, triangles, np.tile(yellow, 2), rays)


def _ray_numbers(n: int) -> Indices:
    """Return the sample numbers along the rays of both fans, (2, n + 1, 2 m + 1) int, from the blue corner.

    Interior samples come fan by fan and ray by ray, those on the diagonal last. What fans and sides share
    has one number by construction; positions, which differ by rounding, are not compared.
    """
    per_side = 2 * radial(n) - 1
    side = 4 + per_side * np.arange(4)[:, None] + np.arange(per_side)[::-1]
    inner = 4 + 4 * per_side + np.arange(2 * (n - 1) * per_side).reshape(2, n - 1, per_side)
    diagonal = np.concatenate([[0], inner.max() + 1 + np.arange(n - 1), [2]])
    rays = np.zeros((2, n + 1, per_side + 2), dtype=np.int64)
    rays[:, :, 0] = [[1], [3]]
    rays[:, 0, 1:-1], rays[:, 1:-1, 1:-1], rays[:, -1, 1:-1] = side[[0, 2]], inner, side[[1, 3]]
    rays[:, :, -1] = diagonal, diagonal[::-1]
    return rays


def _turned(template: TileTemplate) -> TileTemplate:
    """Return the template a quarter turn on, colours exchanged: corner k becomes k + 1, arcs run backwards."""
    per_side = template.rays.shape[2] - 2
    number = np.arange(len(template.uv))
    number[:4] = (np.arange(4) + 1) % 4
    side, step = np.divmod(np.arange(4 * per_side), per_side)
    number[4 : 4 + 4 * per_side] = 4 + (side + 1) % 4 * per_side + (per_side - 1 - step)
    u, v = template.uv[np.argsort(number)].T
    return TileTemplate(
        np.stack([1.0 - v, u], axis=1),
        number[template.triangles],
        ~template.yellow,
        number[template.rays[::-1, ::-1, ::-1]],
    )


def _rim(arc: float, n: int) -> Floats:
    """Return corners and side samples in the template's order."""
    t = side_fractions(arc=arc, resolution=n)[1:-1]
    zero, one = np.zeros_like(t), np.ones_like(t)
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    sides = [(t, zero), (one, 1.0 - t), (1.0 - t, one), (zero, t)]
    return np.concatenate([corners] + [np.stack(side, axis=1) for side in sides])


def _fan(arc: float, n: int) -> Floats:
    """Return the samples on the rays from b1, (n + 1, 2 m + 1, 2), each from the corner to the diagonal."""
    m = radial(n)
    angle = 0.5 * np.pi * np.arange(n + 1)[:, None] / n
    reach = 1.0 / (np.cos(angle) + np.sin(angle))
    inward, outward = np.arange(m) / m, np.arange(m + 1) / m
    radius = np.concatenate(
        [np.broadcast_to((1.0 - arc) * inward, (n + 1, m)), 1.0 - arc + (reach - (1.0 - arc)) * outward], axis=1
    )
    return np.stack([1.0 - radius * np.cos(angle), radius * np.sin(angle)], axis=2)


def _fan_cells(n: int, m: int) -> tuple[Indices, Mask]:
    """Return the triangles of one fan on its (n + 1)(2 m + 1) samples, and which are yellow."""
    ray, step = np.divmod(np.arange(n * 2 * m), 2 * m)
    corner = ray * (2 * m + 1) + step
    quads = np.stack([corner, corner + 1, corner + 2 * m + 2, corner + 2 * m + 1], axis=1)
    # mirrored about the middle ray, so that neither end of the arc is favoured
    early = (2 * ray < n)[:, None, None]
    split = np.where(early, quads[:, [[0, 2, 1], [0, 3, 2]]], quads[:, [[0, 3, 1], [1, 3, 2]]])
    tips = quads[step == 0][:, [0, 2, 1]]
    triangles = np.concatenate([tips, split[step > 0].reshape(-1, 3)])
    yellow = np.concatenate([np.zeros(n, dtype=bool), np.repeat(step[step > 0] >= m, 2)])
    return triangles, yellow
