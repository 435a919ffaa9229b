r"""Tile templates: triangulations of the unit square that conform to the arcs of a tile.

A template is made once for the positions of its rings r1 < r2 < ... < rk and a resolution n; every tile is a copy of
it. The square has y0 at (0, 0), b1 at (1, 0), y2 at (1, 1), b3 at (0, 1). A yellow-joined tile is two fans of rays,
from the blue corners b1 and b3 to the yellow diagonal between them:

    b3 ______t____ y2
     |      /    .|       ray i leaves b1, crosses the arc at A(i), and ends on the diagonal at
     |    _/   .  |       E(i), with E(0) = y0 and E(n) = y2; the fan from b3 is the same, turned
     |___/   .   _t       by half a turn, and ends on the same points
     t     .   _/ |
     |   .    /   |       t marks where the curve crosses a side: rays 0 and n run along the sides
     |_._____t____|
    y0             b1

A duotone has one ring, which makes two arcs, one round each blue corner. Several rings make as many concentric arcs
there, and between them bands that run along the whole curve (Garigipati 2013, 4.5.2). Regions are numbered from
yellow, 0, over the bands to blue, k.

Every ray has m = `radial(n)` steps from its blue corner to the first arc and from the last one to the diagonal, and
an even number across each band, so that the middle of a band is a chain of edges as well. Each arc can be moved along
its rays, as far as the middles of the bands beside it, without folding the triangulation: that is how clearance is
made.

Sides have as many segments as rays, counted from the yellow end, so neighbouring tiles place the same points. A
blue-joined tile is the same construction a quarter turn on, with 1 - r for each r.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from fabricate.arrays import Floats, Indices, frozen
from fabricate.errors import PatternError

ARC_MIN, ARC_MAX = 1.0 - float(np.sqrt(0.5)), float(np.sqrt(0.5))
"""Outside of these positions the two arcs of a ring meet."""


@dataclass(frozen=True, eq=False)
class TileTemplate:
    """A triangulated unit square whose edges include the arcs of a tile.

    Samples are ordered: 4 corners; those on each of the sides 0 to 3, from the side's yellow end; then the
    interior ones.

    Attributes
    ----------
    uv : (s, 2) float
        Position of each sample in the square.
    triangles : (t, 3) int
        Counter-clockwise in the square.
    regions : (t,) int
        Region of each triangle, from yellow, 0, to blue, k.
    rays : (2, n + 1, l + 1) int
        Samples along the rays that cross the arcs entering through side 0 and those entering through
        side 2, in the direction of the curve with yellow on its left; each ray of l steps from its blue to its
        yellow end.
    crossings : (k,) int
        At which step a ray crosses each ring, the ring nearest to yellow first.
    """

    uv: Floats
    triangles: Indices
    regions: Indices
    rays: Indices
    crossings: Indices

    def __post_init__(self) -> None:
        object.__setattr__(self, "uv", frozen(self.uv, np.float64, (None, 2)))
        object.__setattr__(self, "triangles", frozen(self.triangles, np.int64, (None, 3)))
        object.__setattr__(self, "regions", frozen(self.regions, np.int64, (len(self.triangles),)))
        object.__setattr__(self, "rays", frozen(self.rays, np.int64, (2, None, None)))
        object.__setattr__(self, "crossings", frozen(self.crossings, np.int64, (None,)))

    @property
    def arcs(self) -> Indices:
        """(k, 2, n + 1) int: samples along the two arcs of each ring, yellow on the left."""
        return np.moveaxis(self.rays[:, :, self.crossings], 2, 0)


def radial(resolution: int) -> int:
    """Return m, the steps on a ray on either side of all arcs, for n segments along an arc.

    Rays are nearly straight, so they need fewer points than the arcs.
    """
    return max(2, (2 * resolution + 2) // 3)


def ray_steps(*, rings: Sequence[float], resolution: int) -> tuple[int, ...]:
    """Return the steps of a ray from its yellow end to the first ring, across each band, and to its blue end.

    Those across a band are even in number, and about as long as the others.
    """
    m = radial(resolution)
    return m, *(2 * max(1, round(m * (outer - inner))) for inner, outer in pairwise(rings)), m


def tile_template(*, rings: Sequence[float], resolution: int, yellow_joined: bool) -> TileTemplate:
    """Return the template of a yellow-joined or a blue-joined tile with arcs at these fractions of its sides.

    Raises
    ------
    PatternError
        If there are no rings, one is not between 0.293 and 0.707, they do not increase, or the resolution is
        below 2.
    """
    _check_rings(rings)
    if resolution < 2:
        raise PatternError(f"a tile needs at least 2 segments per arc, found {resolution}")
    steps = ray_steps(rings=rings, resolution=resolution)
    if yellow_joined:
        return _joined_template(rings, steps, resolution)
    return _turned(_joined_template([1.0 - ring for ring in reversed(rings)], steps[::-1], resolution))


def _check_rings(rings: Sequence[float]) -> None:
    if not rings:
        raise PatternError("at least one position of an arc was expected, found none")
    for ring in rings:
        if not ARC_MIN < ring < ARC_MAX:
            raise PatternError(f"the arc position must lie between {ARC_MIN:.3f} and {ARC_MAX:.3f}, found {ring:g}")
    for inner, outer in pairwise(rings):
        if not inner < outer:
            raise PatternError(f"rings must increase from yellow to blue, found {outer:g} after {inner:g}")


def side_fractions(*, rings: Sequence[float], resolution: int) -> Floats:
    """Return the fractions from the yellow end at which a tile side is divided, (l + 1,) float."""
    return _side_fractions(rings, ray_steps(rings=rings, resolution=resolution))


def _side_fractions(rings: Sequence[float], steps: Sequence[int]) -> Floats:
    pieces = zip(pairwise((0.0, *rings, 1.0)), steps, strict=True)
    ends = [begin + (end - begin) * (np.arange(1, count + 1) / count) for (begin, end), count in pieces]
    return np.concatenate([[0.0], *ends])


def _joined_template(rings: Sequence[float], steps: Sequence[int], n: int) -> TileTemplate:
    """Join the two fans of a yellow-joined tile at the sides and on the diagonal; `steps` as of `ray_steps`."""
    fan, rays = _fan(rings, steps, n), _ray_numbers(n, sum(steps))
    inner = fan[1:-1, 1:-1].reshape(-1, 2)
    crossings = sum(steps) - np.cumsum(steps)[:-1]
    cells, regions = _fan_cells(n, sum(steps), crossings)
    triangles = rays.reshape(2, -1)[:, cells].reshape(-1, 3)
    uv = np.concatenate([_rim(rings, steps), inner, 1.0 - inner, fan[1:-1, -1]])
    return TileTemplate(uv, triangles, np.tile(regions, 2), rays, crossings)


def _ray_numbers(n: int, length: int) -> Indices:
    """Return the sample numbers along the rays of both fans, (2, n + 1, l + 1) int, from the blue corner.

    Interior samples come fan by fan and ray by ray, those on the diagonal last. What fans and sides share
    has one number by construction; positions, which differ by rounding, are not compared.
    """
    per_side = length - 1
    side = 4 + per_side * np.arange(4)[:, None] + np.arange(per_side)[::-1]
    inner = 4 + 4 * per_side + np.arange(2 * (n - 1) * per_side).reshape(2, n - 1, per_side)
    diagonal = np.concatenate([[0], inner.max() + 1 + np.arange(n - 1), [2]])
    rays = np.zeros((2, n + 1, per_side + 2), dtype=np.int64)
    rays[:, :, 0] = [[1], [3]]
    rays[:, 0, 1:-1], rays[:, 1:-1, 1:-1], rays[:, -1, 1:-1] = side[[0, 2]], inner, side[[1, 3]]
    rays[:, :, -1] = diagonal, diagonal[::-1]
    return rays


def _turned(template: TileTemplate) -> TileTemplate:
    """Return the template a quarter turn on, regions in reverse: corner k becomes k + 1, arcs run backwards."""
    length = template.rays.shape[2] - 1
    per_side = length - 1
    number = np.arange(len(template.uv))
    number[:4] = (np.arange(4) + 1) % 4
    side, step = np.divmod(np.arange(4 * per_side), per_side)
    number[4 : 4 + 4 * per_side] = 4 + (side + 1) % 4 * per_side + (per_side - 1 - step)
    u, v = template.uv[np.argsort(number)].T
    return TileTemplate(
        np.stack([1.0 - v, u], axis=1),
        number[template.triangles],
        len(template.crossings) - template.regions,
        number[template.rays[::-1, ::-1, ::-1]],
        length - template.crossings[::-1],
    )


def _rim(rings: Sequence[float], steps: Sequence[int]) -> Floats:
    """Return corners and side samples in the template's order."""
    t = _side_fractions(rings, steps)[1:-1]
    zero, one = np.zeros_like(t), np.ones_like(t)
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    sides = [(t, zero), (one, 1.0 - t), (1.0 - t, one), (zero, t)]
    return np.concatenate([corners] + [np.stack(side, axis=1) for side in sides])


def _fan(rings: Sequence[float], steps: Sequence[int], n: int) -> Floats:
    """Return the samples on the rays from b1, (n + 1, l + 1, 2), each from the corner to the diagonal."""
    angle = 0.5 * np.pi * np.arange(n + 1)[:, None] / n
    reach = 1.0 / (np.cos(angle) + np.sin(angle))
    radii = [np.zeros_like(reach), *(np.full_like(reach, 1.0 - ring) for ring in reversed(rings)), reach]
    pieces = [
        begin + (end - begin) * (np.arange(count) / count)
        for (begin, end), count in zip(pairwise(radii), reversed(steps), strict=True)
    ]
    radius = np.concatenate([*pieces, reach], axis=1)
    return np.stack([1.0 - radius * np.cos(angle), radius * np.sin(angle)], axis=2)


def _fan_cells(n: int, length: int, crossings: Indices) -> tuple[Indices, Indices]:
    """Return the triangles of one fan on its (n + 1)(l + 1) samples, and the region of each."""
    ray, step = np.divmod(np.arange(n * length), length)
    corner = ray * (length + 1) + step
    quads = np.stack([corner, corner + 1, corner + length + 2, corner + length + 1], axis=1)
    # mirrored about the middle ray, so that neither end of the arc is favoured
    early = (2 * ray < n)[:, None, None]
    split = np.where(early, quads[:, [[0, 2, 1], [0, 3, 2]]], quads[:, [[0, 3, 1], [1, 3, 2]]])
    tips = quads[step == 0][:, [0, 2, 1]]
    triangles = np.concatenate([tips, split[step > 0].reshape(-1, 3)])
    region = len(crossings) - np.searchsorted(crossings[::-1], step, side="right")
    return triangles, np.concatenate([region[step == 0], np.repeat(region[step > 0], 2)])
