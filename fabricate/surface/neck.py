"""Necks: how narrow each colour becomes where it is joined across a tile, and how narrow bands become."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.duotone.catmull_clark import Subdivision, catmull_clark
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.cut import CutSurface
from fabricate.surface.limit import LimitOperator, LimitSurface, Samples
from fabricate.surface.template import tile_template

COARSE = 6
"""Segments of the arcs on which necks are measured quickly: off by less than 3 % of a tile's side."""


DEEPEST = 0.75
"""The least share of its width on the surface that a neck counts with under it, however sharply the body bends there:
no tiling makes a neck wide at the depth of its wall where the wall itself has no room."""

CHUNK = 50_000
"""Tiles measured at once: more would need much memory and would not be faster."""


@dataclass(frozen=True, eq=False)
class NeckGauge:
    """Measures the neck of every tile both ways it can be joined, again and again as control points move.

    `rings` counts the arcs round a corner of a tile, and `depth`, mm, is how far walls go down from the surface: on
    the outside of a bend they come nearer to each other on their way.
    """

    refinement: Subdivision
    arcs: tuple[LimitOperator, ...]
    rings: int
    depth: float

    @classmethod
    def of(cls, quads: QuadMesh, *, rings: Sequence[float], depth: float = 0.0) -> NeckGauge:
        """Prepare for quads with arcs at these positions; only their points may change.

        Raises
        ------
        PatternError
            If the positions are out of range or do not increase.
        """
        templates = [tile_template(rings=rings, resolution=COARSE, yellow_joined=kind) for kind in (True, False)]
        uv = np.concatenate([template.uv[template.arcs.ravel()] for template in templates])
        limit, operators = LimitSurface.of(quads), []
        for begin in range(0, len(quads.tiles), CHUNK):
            tiles = np.arange(begin, min(begin + CHUNK, len(quads.tiles)))
            rows = np.arange(len(tiles) * len(uv)).reshape(len(tiles), len(uv))
            operators.append(limit.operator([Samples(tiles, uv, rows)], size=rows.size))
        return cls(catmull_clark(quads), tuple(operators), len(rings), depth)

    def necks(self, points: Floats) -> Floats:
        """Return the necks of each tile when it is yellow-joined and when it is blue-joined, (t, 2) float, mm.

        Before clearance is taken off, for control points, (n, 3) float, mm; where one of the tile's bands is
        narrower than its neck, the width of that band. Under the surface no more than a quarter is lost.
        """
        control = self.refinement.matrix @ points
        return np.concatenate([self._along_walls(operator, control) for operator in self.arcs])

    def _along_walls(self, operator: LimitOperator, control: Floats) -> Floats:
        """Return the necks at the upper or the lower edge of the walls, whichever is narrower."""
        places = operator.positions(control)
        above = _narrowest(places, self.rings)
        if self.depth == 0.0:
            return above
        below = _narrowest(places - self.depth * operator.normals(control), self.rings)
        return np.clip(below, DEEPEST * above, above)


def _narrowest(places: Floats, rings: int) -> Floats:
    """Return the smallest distance between arcs of each tile in both states, (t, 2) float.

    That is between the two arcs of a ring, and between neighbouring rings.
    """
    arcs = places.reshape(-1, 2, rings, 2, COARSE + 1, 3)
    facing = [(arcs[:, :, ring, 0], arcs[:, :, ring, 1]) for ring in range(rings)]
    facing += [(arcs[:, :, ring, side], arcs[:, :, ring + 1, side]) for ring in range(rings - 1) for side in (0, 1)]
    across = (first[:, :, :, None] - second[:, :, None, :] for first, second in facing)
    necks: Floats = np.minimum.reduce([np.linalg.norm(each, axis=4).min(axis=(2, 3)) for each in across])
    return necks


def coarse_necks(duotone: Duotone, *, rings: Sequence[float], depth: float = 0.0) -> Floats:
    """Return the width of each tile's neck, (t,) float, mm, before clearance is taken off, measured quickly.

    Where a band is narrower it is that of the band; and where walls come nearer to each other on their way down, it is
    the width `depth` mm under the surface.

    Raises
    ------
    PatternError
        If the positions of the arcs are out of range or do not increase.
    """
    both = NeckGauge.of(duotone.quads, rings=rings, depth=depth).necks(duotone.quads.points)
    necks: Floats = np.where(duotone.joined, both[:, 0], both[:, 1])
    return necks


def tile_necks(surface: CutSurface) -> tuple[Floats, Floats]:
    """Return the smallest distance between the two arcs of a ring in each tile, (t,) float, mm, and where, (t, 3).

    It belongs to the colour that is joined across the tile, before clearance is taken off. On a flat square of side
    s it is (sqrt 2 - 2 (1 - r)) s for yellow with its ring r, (sqrt 2 - 2 r) s for blue with its own (Garigipati
    2013, 3.3).
    """
    across = [_nearest(surface, arcs[0::2], arcs[1::2]) for arcs in surface.arcs]
    return _narrower(across)


def band_widths(surface: CutSurface) -> tuple[tuple[Floats, Floats], ...]:
    """Return for each band its width in each tile, (t,) float, mm, before clearance is taken off, and where, (t, 3).

    On a flat square of side s that is (r' - r) s between neighbouring rings r and r'.
    """
    return tuple(
        _narrower([_nearest(surface, inner[side::2], outer[side::2]) for side in (0, 1)])
        for inner, outer in pairwise(surface.arcs)
    )


def _narrower(measured: Sequence[tuple[Floats, Floats]]) -> tuple[Floats, Floats]:
    """Return the smallest of several measures of each tile, and its place."""
    width, place = measured[0]
    for other, elsewhere in measured[1:]:
        place = np.where((other < width)[:, None], elsewhere, place)
        width = np.minimum(width, other)
    return width, place


def _nearest(surface: CutSurface, first_arcs: Indices, second_arcs: Indices) -> tuple[Floats, Floats]:
    """Return the smallest distance between arcs, (t, n + 1) point numbers each, (t,), and where, (t, 3)."""
    first, second = surface.points[first_arcs], surface.points[second_arcs]
    best = np.full(len(first), np.inf)
    place = np.zeros((len(first), 3))
    for k in range(first.shape[1]):
        distance = np.linalg.norm(first[:, k, None] - second, axis=2)
        nearest = distance.argmin(axis=1)
        shorter = distance.min(axis=1)
        better = shorter < best
        best[better] = shorter[better]
        middle = 0.5 * (first[:, k] + second[np.arange(len(second)), nearest])
        place[better] = middle[better]
    return best, place


def tile_areas(surface: CutSurface) -> Floats:
    """Return the area of each tile, (t,) float, mm2, measured between the ends of its rays."""
    ends = surface.points[surface.rays[:, :, [0, -1]]]
    across, back = ends[:, 1:, 1] - ends[:, :-1, 0], ends[:, :-1, 1] - ends[:, 1:, 0]
    halves = 0.5 * np.linalg.norm(np.cross(across, back), axis=2).sum(axis=1)
    areas: Floats = halves[0::2] + halves[1::2]
    return areas
