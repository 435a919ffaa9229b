"""The cut: the limit surface tessellated so that the curves run along its edges, and divided into regions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices, frozen
from fabricate.duotone.curve import traced_arcs
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.limit import LimitSurface, Samples
from fabricate.surface.mitre import crease_sides, mitred_normals
from fabricate.surface.template import TileTemplate, tile_template


class HalfRays(NamedTuple):
    """Point numbers on the rays through each point of a curve, each from the curve to where its regions are halved.

    left : (c, l + 1) int, within the region of the lower number; right : (c, r + 1) int, within the other one.
    """

    left: Indices
    right: Indices


@dataclass(frozen=True, eq=False)
class CutSurface:
    r"""A closed triangle mesh divided into regions, with the curves that are their common boundaries.

    A duotone has one curve, with yellow, region 0, on its left and blue, region 1, on its right. k rings make k
    curves that run side by side, and bands between them: regions 1 to k - 1, and blue is region k. Neighbouring
    regions share the points of the curve between them. A curve is closed and runs with the region of the lower
    number on its left, seen from outside:

             region j
        c0 -->-- c1 -->-- c2          `curves[j]` = [c0, c1, c2, ...], back to c0 at the end
             region j + 1

    Attributes
    ----------
    points, normals : (n, 3) float
        Positions in mm and unit outward normals, both of the exact limit surface. On a crease, which has a normal
        on either side, the direction that leads out of all of them alike.
    triangles : (m, 3) int
        Counter-clockwise seen from outside.
    regions : (m,) int
        Region of each triangle.
    rays : (2 t, n + 1, l + 1) int
        Point numbers along the rays that cross each arc, by arc number (see `duotone.curve`): in the
        direction of the curve, each ray of l steps from its blue to its yellow end. The last ray of an arc is the
        first of the next.
    crossings : (k,) int
        At which step of its rays each curve lies. Midway between two curves is a step as well.
    rings : (k,) float
        Where each curve crosses tile sides, from their yellow ends.
    order : (2 t,) int
        Arc numbers along the curve.
    mitre : (n,) float
        How much further than a depth one has to go against the normal to be that deep under every side of a crease
        (see `surface.mitre`); exactly 1 elsewhere, and everywhere by default.
    along : (n, 3) float
        Unit tangent of the crease at its points; zero at corners and elsewhere, and everywhere by default.
    base : (n, 3) float
        The smooth surface that the inner one follows, mm: without the detail of a surface that `points` were
        carried onto; the points themselves by default.
    """

    points: Floats
    normals: Floats
    triangles: Indices
    regions: Indices
    rays: Indices
    crossings: Indices
    rings: Floats
    order: Indices
    mitre: Floats = field(default_factory=lambda: np.zeros(0))
    along: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    base: Floats = field(default_factory=lambda: np.zeros((0, 3)))

    def __post_init__(self) -> None:
        count = len(self.points)
        for name, nothing in (("mitre", np.ones(count)), ("along", np.zeros((count, 3))), ("base", self.points)):
            if not len(getattr(self, name)):
                object.__setattr__(self, name, nothing)
        for name, dtype, shape in (
            ("points", np.float64, (None, 3)),
            ("normals", np.float64, (count, 3)),
            ("triangles", np.int64, (None, 3)),
            ("regions", np.int64, (len(self.triangles),)),
            ("rays", np.int64, (None, None, None)),
            ("crossings", np.int64, (None,)),
            ("rings", np.float64, (len(self.crossings),)),
            ("order", np.int64, (len(self.rays),)),
            ("mitre", np.float64, (count,)),
            ("along", np.float64, (count, 3)),
            ("base", np.float64, (count, 3)),
        ):
            object.__setattr__(self, name, frozen(getattr(self, name), dtype, shape))

    @property
    def arcs(self) -> Indices:
        """(k, 2 t, n + 1) int: point numbers along each arc of each curve, by arc number."""
        return np.moveaxis(self.rays[:, :, self.crossings], 2, 0)

    @property
    def curve_rays(self) -> Indices:
        """(c, l + 1) int: the ray through each point of the curves, which all have as many points."""
        return self.rays[self.order, :-1].reshape(-1, self.rays.shape[2])

    @property
    def curves(self) -> Indices:
        """(k, c) int: point numbers along each curve, that at yellow first."""
        return self.curve_rays.T[self.crossings]

    @property
    def half_rays(self) -> tuple[HalfRays, ...]:
        """The rays on either side of each curve, as far as the middle of a band or the end in yellow or blue."""
        rays, steps = self.curve_rays, self.crossings
        middles = [rays.shape[1] - 1, *(steps[:-1] + steps[1:]) // 2, 0]
        return tuple(
            HalfRays(rays[:, step : left + 1], rays[:, right : step + 1][:, ::-1])
            for step, left, right in zip(steps, middles, middles[1:], strict=False)
        )


def cut(duotone: Duotone, limit: LimitSurface, *, rings: Sequence[float], resolution: int) -> CutSurface:
    """Tessellate the limit surface with tile templates of the given rings and resolution.

    Points on tile sides are shared by number, so there is no crack to weld.

    Parameters
    ----------
    duotone : Duotone
    limit : LimitSurface
        Of the duotone's quads.
    rings : sequence of float
        Where the curves cross tile sides, from their yellow ends, between 0.293 and 0.707: one for a duotone.
    resolution : int
        Segments of an arc.

    Raises
    ------
    PatternError
        If the tiles form more than one curve, or the rings or the resolution are out of range.
    """
    templates = [tile_template(rings=rings, resolution=resolution, yellow_joined=kind) for kind in (False, True)]
    tiles = [np.flatnonzero(duotone.joined == kind) for kind in (False, True)]
    table = _point_numbers(duotone.quads, templates[0])
    size = int(table.max()) + 1
    operator = limit.operator(
        [Samples(own, template.uv, table[own]) for own, template in zip(tiles, templates, strict=True)],
        size=size,
    )
    rays = np.zeros((2 * len(table), *templates[0].rays.shape[1:]), dtype=np.int64)
    for own, template in zip(tiles, templates, strict=True):
        for side in (0, 1):
            rays[2 * own + side] = table[own][:, template.rays[side]]
    order = traced_arcs(duotone)
    mitred = mitred_normals(operator.normals(limit.control), crease_sides(duotone.quads, limit, templates[0], table))
    return CutSurface(
        operator.positions(limit.control),
        mitred.normals,
        np.concatenate([table[own][:, t.triangles].reshape(-1, 3) for own, t in zip(tiles, templates, strict=True)]),
        np.concatenate([np.tile(t.regions, len(own)) for own, t in zip(tiles, templates, strict=True)]),
        rays,
        templates[0].crossings,
        np.array(rings),
        order,
        mitred.mitre,
        mitred.along,
    )


def _point_numbers(quads: QuadMesh, template: TileTemplate) -> Indices:
    """Return the number of every template sample on every tile, (t, s) int.

    Tile corners keep their numbers, then come the points on tile sides, edge after edge from the yellow
    end, then the interiors, tile after tile. Both templates of a resolution have the same sample counts.
    """
    count, tiles = len(quads.points), len(quads.tiles)
    per_side = template.rays.shape[2] - 2
    inside = len(template.uv) - 4 - 4 * per_side
    edge = quads.half_edges.edge.reshape(-1, 4)
    sides = count + edge[:, :, None] * per_side + np.arange(per_side)
    interior = count + 2 * tiles * per_side + np.arange(tiles * inside).reshape(tiles, inside)
    return np.concatenate([quads.tiles, sides.reshape(tiles, -1), interior], axis=1)
