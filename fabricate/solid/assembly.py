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

from fabricate.arrays import Floats, Indices, frozen
from fabricate.region_names import region_names
from fabricate.solid.facing import wall_gaps
from fabricate.solid.floor import floor_drop, lowered
from fabricate.solid.layers import Layer, flipped, layer, layer_shares, shares_near, wall
from fabricate.solid.part import Part
from fabricate.solid.unfolding import unfolded
from fabricate.surface.cut import CutSurface
from fabricate.triangles.normals import unit

Core: TypeAlias = Literal["hollow", "yellow", "blue"]

CORRECTIONS, MOST_ADDED = 3, 1.25
"""How often walls that are too near are moved apart, and by which factor at most each time."""

NOTHING_MISSING = 1.01
"""Clearance over measured gap from which on walls are moved apart."""

CLOSE = 0.75
"""Over this share of the clearance, below a depth as large as it, the curve on an inner layer comes to lie right under
that on the outer one."""


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
    """

    points: Floats
    bodies: tuple[Indices, ...]
    gap: Indices
    shell: Indices
    surface_points: int

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

    def middles(self, curve: Indices, region: int) -> Floats:
        """Return the mid-line of the joint along a curve, (c,) int, between a region and the next one, (c, 3) mm."""
        n = self.surface_points
        blocks = np.arange(2 * region, 2 * region + 4) if len(self.gap) else np.arange(2)
        middles: Floats = self.points[n * blocks[:, None] + curve].mean(axis=0)
        return middles

    def _part(self, name: str, triangles: Indices) -> Part:
        used = np.zeros(len(self.points), dtype=bool)
        used[triangles] = True
        number = np.cumsum(used) - 1
        return Part(name, self.points[used], number[triangles])


@dataclass(frozen=True)
class _Blocks:
    """Where a part's, or the whole's, copy of each layer begins in the array, from the outside in.

    Only what has a core goes down to the floor, which is the inner layer where the parts touch.
    """

    layers: tuple[int, ...]

    @property
    def outer(self) -> int:
        return self.layers[0]

    @property
    def inner(self) -> int:
        return self.layers[1]

    @property
    def bottom(self) -> int:
        return self.layers[-1]


def core_region(core: Core, *, regions: int) -> int | None:
    """Return the number of the region that keeps the inside."""
    return {"hollow": None, "yellow": 0, "blue": regions - 1}[core]


def assembly(surface: CutSurface, inner: Floats, *, clearance: float, core: Core) -> Assembly:
    """Build all parts between the surface and the points `inner`, (n, 3), one under each of its points, mm."""
    n, regions = len(surface.points), len(surface.crossings) + 1
    keeper = core_region(core, regions=regions)
    if clearance == 0.0:
        whole = _Blocks((0, n))
        places = [whole] * regions
        blocks = [surface.points, inner]
    else:
        outer, under, *floor = _layers(surface, inner, clearance=clearance, keeper=keeper)
        blocks = [copy for pair in zip(outer.copies, under.copies, strict=True) for copy in pair]
        blocks += [surface.points, inner, *(each.copies[keeper] for each in floor if keeper is not None)]
        whole = _Blocks((2 * regions * n, (2 * regions + 1) * n))
        deepest = ((2 * regions + 2) * n,)
        places = [
            _Blocks((2 * region * n, (2 * region + 1) * n) + (deepest if region == keeper else ()))
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
    )


def _layers(surface: CutSurface, inner: Floats, *, clearance: float, keeper: int | None) -> list[Layer]:
    """Return the outer layer, the inner one and, for a core, the floor.

    Where walls lean or twist they are nearer to each other than their edges: there the edges are moved
    further apart, by as much as is missing, a few times; likewise a floor is lowered.
    """
    down = unit(inner - surface.points)
    drop = floor_drop(inner, surface.triangles, down, clearance=clearance)
    depth = np.linalg.norm(inner - surface.points, axis=1)
    nearness = np.clip((clearance - depth[surface.curves]) / (CLOSE * clearance), 0.0, 1.0)
    wanted = np.full(surface.curves.shape, clearance)
    for _ in range(CORRECTIONS):
        levels = [surface.points, inner] + ([] if keeper is None else [inner + drop[:, None] * down])
        outer, inner_own, *floor_own = [layer_shares(surface, points, down, clearance=wanted) for points in levels]
        outer = unfolded(surface, surface.points, outer)
        drawn = tuple(
            shares_near(above, own, nearness=near) for above, own, near in zip(outer, inner_own, nearness, strict=True)
        )
        layers = [layer(surface, *each) for each in zip(levels, [outer, drawn, *floor_own], strict=True)]
        missing = clearance / np.maximum(_wall_gaps(surface, layers, keeper), 1e-9)
        short = (missing > NOTHING_MISSING).any()
        if keeper is not None:
            deeper = _deeper(surface, layers, drop, keeper=keeper, clearance=clearance)
            short |= (deeper > NOTHING_MISSING * drop).any()
            drop = deeper
        if not short:
            break
        wanted = wanted * np.clip(_widened(missing), 1.0, MOST_ADDED)
    return layers


def _deeper(surface: CutSurface, layers: list[Layer], drop: Floats, *, keeper: int, clearance: float) -> Floats:
    """Return how far the floor has to lie below the inner points for the clearance under every other part, (n,) mm."""
    floor = layers[2].copies[keeper]
    deeper = drop
    for region, ceiling in enumerate(layers[1].copies):
        if region != keeper:
            inlaid = surface.triangles[surface.regions == region]
            deeper = np.maximum(deeper, lowered(drop, ceiling, floor, inlaid, clearance=clearance))
    return deeper


def _wall_gaps(surface: CutSurface, layers: list[Layer], keeper: int | None) -> Floats:
    """Return how far apart the walls are beside each curve point, (k, c); only a core's goes down to the floor."""

    def wall_edges(region: int, curve: Indices) -> list[Floats]:
        return [each.copies[region][curve] for each in (layers if region == keeper else layers[:2])]

    sides = [(wall_edges(number, curve), wall_edges(number + 1, curve)) for number, curve in enumerate(surface.curves)]
    return np.stack([wall_gaps(left, right) for left, right in sides])


def _widened(values: Floats) -> Floats:
    """Return for each point of each curve, (k, c), the largest value among it and its neighbours."""
    widened: Floats = np.maximum.reduce([values, np.roll(values, 1, axis=1), np.roll(values, -1, axis=1)])
    return widened


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
