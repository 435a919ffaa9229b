"""The cut: the limit surface tessellated so that the curve runs along its edges, and divided by colour."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from fabricate.arrays import Floats, Indices, Mask, frozen
from fabricate.duotone.curve import traced_arcs
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.limit import LimitSurface, Samples
from fabricate.surface.mitre import crease_sides, mitred_normals
from fabricate.surface.template import TileTemplate, tile_template


@dataclass(frozen=True, eq=False)
class CutSurface:
    r"""A closed triangle mesh whose triangles are yellow or blue, with their common boundary curve.

    Both regions share the curve's points. The curve is closed and runs with yellow on its left, seen
    from outside:

             yellow
        c0 -->-- c1 -->-- c2          `curve` = [c0, c1, c2, ...], back to c0 at the end
              blue

    Attributes
    ----------
    points, normals : (n, 3) float
        Positions in mm and unit outward normals, both of the exact limit surface. On a crease, which has a normal
        on either side, the direction that leads out of all of them alike.
    triangles : (m, 3) int
        Counter-clockwise seen from outside.
    yellow : (m,) bool
        Colour of each triangle.
    curve : (c,) int
        Point numbers along the curve.
    rays : (2 t, n + 1, 2 m + 1) int
        Point numbers along the rays that cross each arc, by arc number (see `duotone.curve`): in the
        direction of the curve, each ray from its blue to its yellow end with the curve in the middle. The
        last ray of an arc is the first of the next.
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
    yellow: Mask
    curve: Indices
    rays: Indices
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
            ("yellow", np.bool_, (len(self.triangles),)),
            ("curve", np.int64, (None,)),
            ("rays", np.int64, (None, None, None)),
            ("order", np.int64, (len(self.rays),)),
            ("mitre", np.float64, (count,)),
            ("along", np.float64, (count, 3)),
            ("base", np.float64, (count, 3)),
        ):
            object.__setattr__(self, name, frozen(getattr(self, name), dtype, shape))

    @property
    def arcs(self) -> Indices:
        """(2 t, n + 1) int: point numbers along each arc, by arc number."""
        return self.rays[:, :, self.rays.shape[2] // 2]

    @property
    def curve_rays(self) -> Indices:
        """(c, 2 m + 1) int: the ray through each point of the curve."""
        return self.rays[self.order, :-1].reshape(-1, self.rays.shape[2])


def cut(duotone: Duotone, limit: LimitSurface, *, arc: float, resolution: int) -> CutSurface:
    """Tessellate the limit surface with tile templates of the given arc position and resolution.

    Points on tile sides are shared by number, so there is no crack to weld.

    Raises
    ------
    PatternError
        If the tiles form more than one curve, or the arc position or the resolution is out of range.
    """
    templates = [tile_template(arc=arc, resolution=resolution, yellow_joined=kind) for kind in (False, True)]
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
    middle = rays.shape[2] // 2
    mitred = mitred_normals(operator.normals(limit.control), crease_sides(duotone.quads, limit, templates[0], table))
    return CutSurface(
        operator.positions(limit.control),
        mitred.normals,
        np.concatenate([table[own][:, t.triangles].reshape(-1, 3) for own, t in zip(tiles, templates, strict=True)]),
        np.concatenate([np.tile(t.yellow, len(own)) for own, t in zip(tiles, templates, strict=True)]),
        rays[order, :-1, middle].ravel(),
        rays,
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
