"""Parts put together from layers: which triangles on which layer bound which part.

Layers lie one under the other, each with a copy for either part; between the facing copies is the gap:

      outer yellow  |  outer blue        core = "hollow": each part is its region between the outer and
        |  wall     |   wall |           the inner layer. core = "blue": blue goes on under yellow, down
      inner yellow  |  inner blue        to the floor, a copy of yellow's inner surface deeper by the
     ---- floor ---------- |             clearance, and has no inner surface of its own.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from fabricate.arrays import Floats, Indices, frozen
from fabricate.solid.facing import wall_gaps
from fabricate.solid.floor import floor_drop, lowered
from fabricate.solid.layers import Layer, flipped, hugging, layer, layer_shares, shares_near, wall
from fabricate.solid.part import Part
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

    Number p stands for the surface point `p % surface_points` on some layer. Without clearance both parts
    use the same numbers along the wall, so their faces there are the same to the last bit.

    Attributes
    ----------
    points : (k, 3) float
        float32-exact, mm.
    yellow, blue : (m, 3) int
        The two parts, outward-oriented.
    gap : (m, 3) int
        The space between the parts, outward-oriented; empty when the clearance is zero.
    shell : (m, 3) int
        The whole, uncut.
    surface_points : int
        Number of points of the surface.
    """

    points: Floats
    yellow: Indices
    blue: Indices
    gap: Indices
    shell: Indices
    surface_points: int

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen(self.points, np.float64, (None, 3)))
        for name in ("yellow", "blue", "gap", "shell"):
            object.__setattr__(self, name, frozen(getattr(self, name), np.int64, (None, 3)))

    @property
    def parts(self) -> tuple[Part, Part]:
        """The yellow and the blue part."""
        return self._part("yellow", self.yellow), self._part("blue", self.blue)

    @property
    def spaces(self) -> tuple[Part, Part]:
        """The gap and the uncut shell, as closed meshes."""
        return self._part("gap", self.gap), self._part("shell", self.shell)

    def _part(self, name: str, triangles: Indices) -> Part:
        used = np.zeros(len(self.points), dtype=bool)
        used[triangles] = True
        number = np.cumsum(used) - 1
        return Part(name, self.points[used], number[triangles])


class _Blocks(NamedTuple):
    """Where each layer's points begin in the array."""

    outer: int
    inner: int
    floor: int


def assembly(surface: CutSurface, inner: Floats, *, clearance: float, core: Core) -> Assembly:
    """Build both parts between the surface and the points `inner`, (n, 3), one under each of its points, mm."""
    n = len(surface.points)
    if clearance == 0.0:
        yellow_at = blue_at = whole_at = _Blocks(0, n, n)
        blocks = [surface.points, inner]
    else:
        outer, *under = _layers(surface, inner, clearance=clearance, core=core)
        blocks = [outer.yellow, under[0].yellow, outer.blue, under[0].blue, surface.points, inner]
        blocks += [copy for floor in under[1:] for copy in (floor.yellow, floor.blue)]
        yellow_at, blue_at, whole_at = _Blocks(0, n, 6 * n), _Blocks(2 * n, 3 * n, 7 * n), _Blocks(4 * n, 5 * n, 5 * n)
    yellow_outside, yellow_facing = _faces(surface, yellow_at, surface.yellow, core, own="yellow")
    blue_outside, blue_facing = _faces(surface, blue_at, ~surface.yellow, core, own="blue")
    return Assembly(
        np.concatenate(blocks).astype(np.float32).astype(np.float64) + 0.0,  # -0.0 becomes 0.0
        np.concatenate([yellow_outside, yellow_facing]),
        np.concatenate([blue_outside, blue_facing]),
        _gap(surface, yellow_at, blue_at, np.concatenate([yellow_facing, blue_facing]), core)
        if clearance > 0.0
        else np.zeros((0, 3), dtype=np.int64),
        _shell(surface, whole_at, core),
        n,
    )


def _layers(surface: CutSurface, inner: Floats, *, clearance: float, core: Core) -> list[Layer]:
    """Return the outer layer, the inner one and, for a core, the floor.

    Where walls lean or twist they are nearer to each other than their edges: there the edges are moved
    further apart, by as much as is missing, a few times; likewise a floor is lowered.
    """
    down = unit(inner - surface.points)
    drop = floor_drop(inner, surface.triangles, down, clearance=clearance)
    depth = np.linalg.norm(inner - surface.points, axis=1)
    nearness = np.clip((clearance - depth[surface.curve]) / (CLOSE * clearance), 0.0, 1.0)
    inlaid = surface.triangles[surface.yellow if core == "blue" else ~surface.yellow]
    wanted = np.full(len(surface.curve), clearance)
    for _ in range(CORRECTIONS):
        levels = [surface.points, inner] + ([] if core == "hollow" else [inner + drop[:, None] * down])
        outer, inner_own, *floor_own = [layer_shares(surface, points, down, clearance=wanted) for points in levels]
        shares = [outer, shares_near(outer, inner_own, nearness=nearness), *floor_own]
        layers = [layer(surface, *each) for each in zip(levels, shares, strict=True)]
        layers[1] = hugging(surface, layers[0], layers[1], depth=depth)
        missing = clearance / np.maximum(_wall_gaps(surface, layers, core), 1e-9)
        short = (missing > NOTHING_MISSING).any()
        if core != "hollow":
            ceiling, floor = (
                (layers[1].yellow, layers[2].blue) if core == "blue" else (layers[1].blue, layers[2].yellow)
            )
            deeper = lowered(drop, ceiling, floor, inlaid, clearance=clearance)
            short |= (deeper > NOTHING_MISSING * drop).any()
            drop = deeper
        if not short:
            break
        wanted = wanted * np.clip(_widened(missing), 1.0, MOST_ADDED)
    return layers


def _wall_gaps(surface: CutSurface, layers: list[Layer], core: Core) -> Floats:
    """Return how far apart the walls are beside each curve point; only a core's goes down to the floor."""
    yellow, blue = (
        [copy[surface.curve] for copy in copies]
        for copies in ([each.yellow for each in layers], [each.blue for each in layers])
    )
    return wall_gaps(yellow if core != "blue" else yellow[:2], blue if core != "yellow" else blue[:2])


def _widened(values: Floats) -> Floats:
    """Return for each curve point the largest value among it and its neighbours."""
    widened: Floats = np.maximum.reduce([values, np.roll(values, 1), np.roll(values, -1)])
    return widened


def _faces(
    surface: CutSurface, at: _Blocks, region: np.ndarray, core: Core, *, own: Literal["yellow", "blue"]
) -> tuple[Indices, Indices]:
    """Return a part's triangles towards the outside and the inside, and those that face the other part."""
    mine, other = surface.triangles[region], surface.triangles[~region]
    rings = [at.outer, at.inner] if core != own or at.inner == at.floor else list(at)
    walls = np.concatenate([wall(surface.curve, lower, upper) for upper, lower in itertools.pairwise(rings)])
    walls = walls if own == "yellow" else flipped(walls)
    under = flipped(mine) + at.inner
    if core == own:
        return mine + at.outer, np.concatenate([walls, other + at.floor])
    if core == "hollow":
        return np.concatenate([mine + at.outer, under]), walls
    return mine + at.outer, np.concatenate([walls, under])


def _gap(surface: CutSurface, yellow: _Blocks, blue: _Blocks, facing: Indices, core: Core) -> Indices:
    """Return the gap's boundary: the parts' facing triangles turned round, and the strips that close it."""
    strips = [wall(surface.curve, blue.outer, yellow.outer)]
    if core == "hollow":
        strips.append(wall(surface.curve, yellow.inner, blue.inner))
    return np.concatenate([flipped(facing), *strips])


def _shell(surface: CutSurface, at: _Blocks, core: Core) -> Indices:
    outside = surface.triangles + at.outer
    return np.concatenate([outside, flipped(surface.triangles) + at.inner]) if core == "hollow" else outside
