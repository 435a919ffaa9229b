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
from fabricate.solid.joint import STRAIGHT, Joint, asides, gently, ridges
from fabricate.solid.layers import (
    Layer,
    flipped,
    hugging,
    layer,
    layer_shares,
    moved_aside,
    shares_aside,
    shares_near,
    wall,
)
from fabricate.solid.part import Part
from fabricate.solid.unfolding import unfolded
from fabricate.surface.cut import CutSurface
from fabricate.triangles.normals import unit

Core: TypeAlias = Literal["hollow", "yellow", "blue"]

CORRECTIONS, MOST_ADDED = 3, 1.25
"""How often walls are measured to move apart what is too near, and by which factor they move at most each time."""

EASINGS = {"straight": 0, "draft": 1, "tongue": 3}
"""How often before that joints become smaller where walls are too near."""

EASED, EASIER = {"straight": np.inf, "draft": 1.04, "tongue": 1.025}, 0.6
"""Clearance over measured gap from which on a joint gets smaller, and to which share each time: walls moved apart as
far as that would leave too wide a gap."""

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
        walls = self.walls(curve, region)
        middles: Floats = walls[:, 1:-1].mean(axis=0) if walls.shape[1] > 2 else walls.mean(axis=(0, 1))
        return middles.reshape(-1, 3)

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


@dataclass(frozen=True, eq=False)
class _Layers:
    """The layers of all parts; rings of the walls between the outer and the inner one; the floor of a core."""

    outer: Layer
    inner: Layer
    rings: list[Layer]
    floor: Layer | None

    def down(self, *, to_floor: bool) -> list[Layer]:
        """Return those that a wall runs along, from the outside in."""
        floor = [self.floor] if to_floor and self.floor is not None else []
        return [self.outer, *self.rings, self.inner, *floor]


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
        found = _layers(surface, inner, clearance=clearance, keeper=keeper, joint=joint)
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


def _layers(surface: CutSurface, inner: Floats, *, clearance: float, keeper: int | None, joint: Joint) -> _Layers:
    """Return all layers.

    Where walls lean or twist they are nearer to each other than their edges: there the edges are moved
    further apart, by as much as is missing, a few times; likewise a floor is lowered.
    """
    down = unit(inner - surface.points)
    drop = floor_drop(inner, surface.triangles, down, clearance=clearance)
    depth = np.linalg.norm(inner - surface.points, axis=1)
    nearness = np.clip((clearance - depth[surface.curves]) / (CLOSE * clearance), 0.0, 1.0)
    aside = asides(surface, inner, joint, clearance=clearance) if joint.kind == "draft" else ()
    wanted, size = np.full(surface.curves.shape, clearance), np.ones(surface.curves.shape)
    easings = EASINGS[joint.kind]
    for step in range(easings + CORRECTIONS):
        levels = [surface.points, inner] + ([] if keeper is None else [inner + drop[:, None] * down])
        outer_own, *under = [layer_shares(surface, points, down, clearance=wanted) for points in levels]
        outer_own = unfolded(surface, surface.points, outer_own)
        under[0] = tuple(
            shares_near(above, own, nearness=near)
            for above, own, near in zip(outer_own, under[0], nearness, strict=True)
        )
        if joint.kind == "draft":
            eased = [share * full for share, full in zip(size, aside, strict=True)]
            under = [shares_aside(surface, *each, asides=eased) for each in zip(levels[1:], under, strict=True)]
        outer, lower, *floor = [layer(surface, *each) for each in zip(levels, [outer_own, *under], strict=True)]
        lower = hugging(surface, outer, lower, depth=depth)
        rings = ridges(surface, outer, lower, joint, size=size, clearance=clearance)
        layers = _Layers(outer, lower, rings, floor[0] if floor else None)
        missing = clearance / np.maximum(_wall_gaps(surface, layers, keeper), 1e-9)
        short = (missing > NOTHING_MISSING).any()
        if keeper is not None:
            deeper = _deeper(surface, layers, drop, keeper=keeper, clearance=clearance)
            short |= (deeper > NOTHING_MISSING * drop).any()
            drop = deeper
        if not short:
            break
        ease = EASED[joint.kind] if step < easings else np.inf
        size = _eased(size, missing, ease=ease)
        wanted = wanted * np.clip(_widened(missing), 1.0, min(MOST_ADDED, ease))
    return layers


def _eased(size: Floats, missing: Floats, *, ease: float) -> Floats:
    """Return the size of a joint along each curve, (k, c) as shares, smaller where more of the gap is missing there."""
    tight = missing > ease
    return np.stack([gently(each) for each in size * np.where(tight, EASIER, 1.0)]) if tight.any() else size


def _common(surface: CutSurface, ring: Layer) -> Floats:
    """Return a ring of parts that touch, whose copies are the same, as one, (n, 3); only curves have points there."""
    points = np.zeros_like(surface.points)
    for copy, curve in zip(ring.copies, surface.curves, strict=False):
        points[curve] = copy[curve]
    return points


def _deeper(surface: CutSurface, layers: _Layers, drop: Floats, *, keeper: int, clearance: float) -> Floats:
    """Return how far the floor has to lie below the inner points for the clearance under every other part, (n,) mm."""
    deeper = drop
    for region, ceiling in enumerate(layers.inner.copies):
        if region != keeper and layers.floor is not None:
            floor = layers.floor.copies[keeper]
            inlaid = surface.triangles[surface.regions == region]
            deeper = np.maximum(deeper, lowered(drop, ceiling, floor, inlaid, clearance=clearance))
    return deeper


def _wall_gaps(surface: CutSurface, layers: _Layers, keeper: int | None) -> Floats:
    """Return how far apart the walls are beside each curve point, (k, c); only a core's goes down to the floor."""

    def wall_edges(region: int, curve: Indices) -> list[Floats]:
        return [each.copies[region][curve] for each in layers.down(to_floor=region == keeper)]

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
