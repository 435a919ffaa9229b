"""Necks: how narrow each colour becomes where it is joined across a tile."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats
from fabricate.duotone.catmull_clark import Subdivision, catmull_clark
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.cut import CutSurface
from fabricate.surface.limit import LimitOperator, LimitSurface, Samples
from fabricate.surface.template import tile_template

COARSE = 6
"""Segments of the arcs on which necks are measured quickly: off by less than 3 % of a tile's side."""


CHUNK = 50_000
"""Tiles measured at once: more would need much memory and would not be faster."""


@dataclass(frozen=True, eq=False)
class NeckGauge:
    """Measures the neck of every tile both ways it can be joined, again and again as control points move."""

    refinement: Subdivision
    arcs: tuple[LimitOperator, ...]

    @classmethod
    def of(cls, quads: QuadMesh, *, arc: float) -> NeckGauge:
        """Prepare for quads with this arc position; only their points may change.

        Raises
        ------
        PatternError
            If the arc position is out of range.
        """
        templates = [tile_template(arc=arc, resolution=COARSE, yellow_joined=kind) for kind in (True, False)]
        uv = np.concatenate([template.uv[template.arcs.ravel()] for template in templates])
        limit, operators = LimitSurface.of(quads), []
        for begin in range(0, len(quads.tiles), CHUNK):
            tiles = np.arange(begin, min(begin + CHUNK, len(quads.tiles)))
            rows = np.arange(len(tiles) * len(uv)).reshape(len(tiles), len(uv))
            operators.append(limit.operator([Samples(tiles, uv, rows)], size=rows.size))
        return cls(catmull_clark(quads), tuple(operators))

    def necks(self, points: Floats) -> Floats:
        """Return the necks of each tile when it is yellow-joined and when it is blue-joined, (t, 2) float, mm.

        Before clearance is taken off, for control points, (n, 3) float, mm.
        """
        control = self.refinement.matrix @ points
        return np.concatenate([_narrowest(operator.positions(control)) for operator in self.arcs])


def _narrowest(places: Floats) -> Floats:
    """Return the smallest distance between the two arcs of each tile in both states, (t, 2) float."""
    arcs = places.reshape(-1, 2, 2, COARSE + 1, 3)
    across = arcs[:, :, 0, :, None] - arcs[:, :, 1, None, :]
    necks: Floats = np.linalg.norm(across, axis=4).min(axis=(2, 3))
    return necks


def coarse_necks(duotone: Duotone, *, arc: float) -> Floats:
    """Return the width of each tile's neck, (t,) float, mm, before clearance is taken off, measured quickly.

    Raises
    ------
    PatternError
        If the arc position is out of range.
    """
    both = NeckGauge.of(duotone.quads, arc=arc).necks(duotone.quads.points)
    necks: Floats = np.where(duotone.joined, both[:, 0], both[:, 1])
    return necks


def tile_necks(surface: CutSurface) -> tuple[Floats, Floats]:
    """Return the smallest distance between the two arcs of each tile, (t,) float, mm, and where, (t, 3).

    It belongs to the colour that is joined across the tile, before clearance is taken off. On a flat square of side
    s it is (sqrt 2 - 2 (1 - r)) s for yellow, (sqrt 2 - 2 r) s for blue (Garigipati 2013, 3.3).
    """
    first, second = surface.points[surface.arcs[0::2]], surface.points[surface.arcs[1::2]]
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
