"""Parts put together from layers: which triangles on which layer bound which part.

Layers lie one under the other, each with a copy for every part; between the facing copies is the gap:

      outer yellow  |  outer blue        core = "hollow": each part is its region between the outer and
        |  wall     |   wall |           the inner layer. core = "blue": blue goes on under all the others,
      inner yellow  |  inner blue        down to the floor, a copy of their inner surface deeper by the
     ---- floor ---------- |             clearance, and has no inner surface of its own.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from fabricate.arrays import Floats, Indices, Mask, frozen
from fabricate.region_names import region_names
from fabricate.solid.facing import mid_lines
from fabricate.solid.joint import STRAIGHT, Joint, asides, ridges
from fabricate.solid.layers import Layer, flipped, moved_aside, wall
from fabricate.solid.part import Part
from fabricate.solid.wall_layers import wall_layers
from fabricate.surface.cut import CutSurface

Core: TypeAlias = Literal["hollow", "yellow", "blue"]


@dataclass(frozen=True, eq=False)
class Assembly:
    """All layers' points in one array, and closed triangle meshes on them.

    Number p stands for the surface point `p % surface_points` on some layer. With a clearance every part has its own
    outer and inner block of numbers, by region; without one all parts use the same numbers along the walls, so their
    faces there are the same to the last bit.

    Attributes
    ----------
    points : (k, 3) float
        float32-exact, mm.
    bodies : tuple of (m, 3) int
        The parts by region, from yellow over the bands to blue, outward-oriented.
    gap : (m, 3) int
        The space between the parts, outward-oriented; empty when the clearance is zero.
    shell : (m, 3) int
        The whole, uncut.
    surface_points : int
        Number of points of the surface.
    levels : tuple of tuple of int
        Where each part's copies of the surface's points begin, by region: on the outer layer, on the rings of its
        walls, and on the inner layer.
    """

    points: Floats
    bodies: tuple[Indices, ...]
    gap: Indices
    shell: Indices
    surface_points: int
    levels: tuple[tuple[int, ...], ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen(self.points, np.float64, (None, 3)))
        object.__setattr__(self, "bodies", tuple(frozen(body, np.int64, (None, 3)) for body in self.bodies))
        for name in ("gap", "shell"):
            object.__setattr__(self, name, frozen(getattr(self, name), np.int64, (None, 3)))

    @property
    def parts(self) -> tuple[Part, ...]:
        """The parts by region: yellow, bands, blue."""
        return tuple(map(self._part, region_names(len(self.bodies)), self.bodies))

    @property
    def spaces(self) -> tuple[Part, Part]:
        """The gap and the uncut shell, as closed meshes."""
        return self._part("gap", self.gap), self._part("shell", self.shell)

    @property
    def inner(self) -> Floats:
        """(n, 3) float: the inner side of the uncut wall under each point of the surface, mm."""
        block = 2 * len(self.bodies) + 1 if len(self.gap) else 1
        return self.points[block * self.surface_points : (block + 1) * self.surface_points]

    def moved_since(self, before: Assembly) -> Mask:
        """Return the surface points, (n,) bool, of which a copy lies elsewhere than in an assembly of the same make."""
        moved = (self.points != before.points).any(axis=1).reshape(-1, self.surface_points)
        anywhere: Mask = moved.any(axis=0)
        return anywhere

    def walls(self, curve: Indices, region: int) -> Floats:
        """Return the facing walls along a curve, (c,) int, of a region and of the next one, (2, l, c, 3) mm.

        Each is l copies of the curve, from the outside in.
        """
        begins = np.array(self.levels[region : region + 2])
        walls: Floats = self.points[begins[:, :, None] + curve]
        return walls

    def joint_faces(self, curves: Indices, region: int) -> Indices:
        """Return the triangles of a region's part along the curves, (k, c) int, that face other parts, (m, 3) int."""
        rings = list(itertools.pairwise(self.levels[region]))
        sides = [curve for number, curve in enumerate(curves) if number in (region - 1, region)]
        return np.concatenate([wall(curve, lower, upper) for curve in sides for upper, lower in rings])

    def middles(self, curve: Indices, region: int) -> Floats:
        """Return the mid-line of the joint along a curve, (c,) int, between a region and the next one, (k, 3) mm.

        Of walls with a ridge it is one along each of the ridge's rings.
        """
        return mid_lines(self.walls(curve, region)).reshape(-1, 3)

    def _part(self, name: str, triangles: Indices) -> Part:
        used = np.zeros(len(self.points), dtype=bool)
        used[triangles] = True
        number = np.cumsum(used) - 1
        return Part(name, self.points[used], number[triangles])


@dataclass(frozen=True, kw_only=True)
class _Blocks:
    """Where a part's, or the whole's, copy of each layer begins in the array.

    Between the outer and the inner layer its walls may have rings. Only what has a core goes down to the floor, which
    is the inner layer where the parts touch.
    """

    outer: int
    inner: int
    rings: tuple[int, ...] = ()
    floor: int | None = None

    @property
    def walls(self) -> tuple[int, ...]:
        """From the outer layer to the inner one."""
        return (self.outer, *self.rings, self.inner)

    @property
    def layers(self) -> tuple[int, ...]:
        """From the outside in."""
        return self.walls if self.floor is None else (*self.walls, self.floor)

    @property
    def bottom(self) -> int:
        return self.layers[-1]


def core_region(core: Core, *, regions: int) -> int | None:
    """Return the number of the region that keeps the inside."""
    return {"hollow": None, "yellow": 0, "blue": regions - 1}[core]


def assembly(surface: CutSurface, inner: Floats, *, clearance: float, core: Core, joint: Joint = STRAIGHT) -> Assembly:
    """Build all parts between the surface and the points `inner`, (n, 3), one under each of its points, mm."""
    n, regions = len(surface.points), len(surface.crossings) + 1
    keeper = core_region(core, regions=regions)
    if clearance == 0.0:
        under = inner
        if joint.kind == "draft":
            under = moved_aside(surface, inner, asides(surface, inner, joint, clearance=0.0))
        full = np.ones(surface.curves.shape)
        touching = (Layer((surface.points,) * regions), Layer((under,) * regions))
        rings = [_common(surface, ring) for ring in ridges(surface, *touching, joint, size=full, clearance=0.0)]
        whole = _Blocks(outer=0, inner=n, rings=tuple((2 + k) * n for k in range(len(rings))))
        places = [whole] * regions
        blocks = [surface.points, under, *rings]
    else:
        found = wall_layers(surface, inner, clearance=clearance, keeper=keeper, joint=joint)
        blocks = [copy for pair in zip(found.outer.copies, found.inner.copies, strict=True) for copy in pair]
        blocks += [surface.points, inner, *(copy for ring in found.rings for copy in ring.copies)]
        floor = len(blocks) * n if found.floor is not None else None
        blocks += [found.floor.copies[keeper]] if found.floor is not None and keeper is not None else []
        whole = _Blocks(outer=2 * regions * n, inner=(2 * regions + 1) * n)
        places = [
            _Blocks(
                outer=2 * region * n,
                inner=(2 * region + 1) * n,
                rings=tuple((2 * regions + 2 + regions * k + region) * n for k in range(len(found.rings))),
                floor=floor if region == keeper else None,
            )
            for region in range(regions)
        ]
    faces = [_faces(surface, at, region, keeper) for region, at in enumerate(places)]
    return Assembly(
        np.concatenate(blocks).astype(np.float32).astype(np.float64) + 0.0,  # -0.0 becomes 0.0
        tuple(np.concatenate(each) for each in faces),
        _gap(surface, places, np.concatenate([facing for _, facing in faces]), keeper)
        if clearance > 0.0
        else np.zeros((0, 3), dtype=np.int64),
        _shell(surface, whole, keeper),
        n,
        tuple(each.walls for each in places),
    )


def _common(surface: CutSurface, ring: Layer) -> Floats:
    """Return a ring of parts that touch, whose copies are the same, as one, (n, 3); only curves have points there."""
    points = np.zeros_like(surface.points)
    for copy, curve in zip(ring.copies, surface.curves, strict=False):
        points[curve] = copy[curve]
    return points


def _faces(surface: CutSurface, at: _Blocks, region: int, keeper: int | None) -> tuple[Indices, Indices]:
    """Return a part's triangles towards the outside and the inside, and those that face other parts."""
    own = surface.regions == region
    mine, others = surface.triangles[own], surface.triangles[~own]
    walls = []
    for number, curve in enumerate(surface.curves):
        if number in (region - 1, region):
            down = np.concatenate([wall(curve, lower, upper) for upper, lower in itertools.pairwise(at.layers)])
            walls.append(down if number == region else flipped(down))
    under = flipped(mine) + at.inner
    if keeper is None:
        return np.concatenate([mine + at.outer, under]), np.concatenate(walls)
    if keeper == region:
        return mine + at.outer, np.concatenate([*walls, others + at.bottom])
    return mine + at.outer, np.concatenate([*walls, under])


def _gap(surface: CutSurface, places: list[_Blocks], facing: Indices, keeper: int | None) -> Indices:
    """Return the gap's boundary: the parts' facing triangles turned round, and the strips that close it."""
    strips = []
    for curve, (left, right) in zip(surface.curves, itertools.pairwise(places), strict=True):
        strips.append(wall(curve, right.outer, left.outer))
        if keeper is None:
            strips.append(wall(curve, left.inner, right.inner))
    return np.concatenate([flipped(facing), *strips])


def _shell(surface: CutSurface, at: _Blocks, keeper: int | None) -> Indices:
    outside = surface.triangles + at.outer
    return np.concatenate([outside, flipped(surface.triangles) + at.inner]) if keeper is None else outside
