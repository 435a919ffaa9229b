"""Layers whose facing walls are as far apart as the clearance: measured, moved, and measured again.

Where walls lean or twist they are nearer to each other than their edges: there the edges are moved further apart, by as
much as is missing, a few times, and a joint gets smaller. Where the gap has become far too wide, as where copies in
tight bends were pushed apart at their edges, they are drawn together again as far as the clearance allows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.solid.clearance import Shares
from fabricate.solid.facing import WallGaps, middle_gaps
from fabricate.solid.floor import floor_drop, lowered
from fabricate.solid.joint import Joint, asides, ridges, tapered
from fabricate.solid.layers import Layer, layer, layer_shares, shares_aside, shares_near
from fabricate.solid.lips import lip_steepness
from fabricate.solid.unfolding import unfolded
from fabricate.surface.cut import CutSurface
from fabricate.triangles.normals import unit, vertex_normals

CORRECTIONS, MOST_ADDED = 3, 1.25
"""How often walls are measured to move apart what is too near, and by which factor they move at most each time."""

EASINGS = {"straight": 0, "draft": 1, "tongue": 3}
"""How often before that joints become smaller where walls are too near."""

EASED, EASIER = {"straight": np.inf, "draft": 1.04, "tongue": 1.025}, 0.6
"""Clearance over measured gap from which on a joint gets smaller, and to which share at least each time: walls moved
apart as far as that would leave too wide a gap."""

BLUNT = 0.74
"""Sine of the angle between the wall and a groove's sides from which on it gets smaller: steeper ones have walls beside
them, not lips."""

EASED_TAPER = 0.15
"""By how much that share changes at most for each mm along the curve."""

NOTHING_MISSING = 1.01
"""Clearance over measured gap from which on walls are moved apart."""

DRAWINGS = 5
"""How often walls are then measured to draw together what is too wide."""

WIDE, DRAWN, KEPT = 1.28, 1.26, 0.985
"""From how wide a gap along the mid-line on walls are drawn together, and to which, as long as this much is left of the
smallest gap beside it; all in clearances."""

CLOSE = 0.75
"""Over this share of the clearance, below a depth as large as it, the curve on an inner layer comes to lie right under
that on the outer one."""


@dataclass(frozen=True, eq=False)
class WallLayers:
    """The layers of all parts; rings of the walls between the outer and the inner one; the floor of a core."""

    outer: Layer
    inner: Layer
    rings: list[Layer]
    floor: Layer | None

    def down(self, *, to_floor: bool) -> list[Layer]:
        """Return those that a wall runs along, from the outside in."""
        floor = [self.floor] if to_floor and self.floor is not None else []
        return [self.outer, *self.rings, self.inner, *floor]


class _Moves(NamedTuple):
    """What is changed between measurements, at each point of each curve, (k, c) float.

    wanted : how far apart the copies on each layer are to be, mm; size : of the joint, as a share;
    drawn : to which share of their way the copies are drawn back; drop : (n,), of the floor, mm.
    """

    wanted: Floats
    size: Floats
    drawn: Floats
    drop: Floats


@dataclass(frozen=True, eq=False, kw_only=True)
class _Task:
    """What is the same for all measurements: the surface, the points under it, and what is to be made of them."""

    surface: CutSurface
    inner: Floats
    clearance: float
    keeper: int | None
    joint: Joint

    @property
    def down(self) -> Floats:
        return unit(self.inner - self.surface.points)

    @property
    def depth(self) -> Floats:
        depth: Floats = np.linalg.norm(self.inner - self.surface.points, axis=1)
        return depth

    def levels(self, drop: Floats) -> list[Floats]:
        """Return where the points of each layer are: the surface, the inner side, and the floor of a core."""
        floor = [] if self.keeper is None else [self.inner + drop[:, None] * self.down]
        return [self.surface.points, self.inner, *floor]


def wall_layers(
    surface: CutSurface, inner: Floats, *, clearance: float, keeper: int | None, joint: Joint
) -> WallLayers:
    """Return the layers between the surface and the points `inner`, (n, 3) mm, one under each of its points.

    The facing walls are `clearance` mm apart. `keeper` is the region that has a core and goes down to the floor. Beside
    a core nothing is drawn together: its floor would come too near.
    """
    task = _Task(surface=surface, inner=inner, clearance=clearance, keeper=keeper, joint=joint)
    moves, shares, layers, measured = _moved_apart(task)
    for _ in range(DRAWINGS if keeper is None else 0):
        wide = _widened(_middle_gaps(surface, layers)) / clearance
        if not (wide > WIDE).any():
            break
        measured = _measured(surface, layers, keeper, measured)
        least = -_widened(-_smallest(measured)) / clearance
        moves = _drawn_together(surface, moves, wide, least)
        layers = _laid(task, shares, moves)
    return layers


class _Apart(NamedTuple):
    """How copies and joints have moved, before they are drawn together, and the walls that this makes, measured."""

    moves: _Moves
    shares: list[tuple[Shares, ...]]
    layers: WallLayers
    measured: list[WallGaps]


def _moved_apart(task: _Task) -> _Apart:
    """Return walls nowhere nearer than the clearance, if they can be."""
    surface, clearance, keeper = task.surface, task.clearance, task.keeper
    full = np.ones(surface.curves.shape)
    drop = floor_drop(task.inner, surface.triangles, task.down, clearance=clearance)
    moves = _Moves(clearance * full, full, full, drop)
    easings = EASINGS[task.joint.kind]
    measured: list[WallGaps] = []
    for step in range(easings + CORRECTIONS):
        shares = _shares(task, moves)
        layers = _laid(task, shares, moves)
        measured = _measured(surface, layers, keeper, measured)
        missing = clearance / np.maximum(_smallest(measured), 1e-9)
        drop = (
            moves.drop if keeper is None else _deeper(surface, layers, moves.drop, keeper=keeper, clearance=clearance)
        )
        ease = EASED[task.joint.kind] if step < easings else np.inf
        smaller = _easier(_widened(missing), ease)
        if step < easings:
            smaller = np.minimum(smaller, _blunt(task, layers))
        short = (missing > NOTHING_MISSING).any() or (drop > NOTHING_MISSING * moves.drop).any()
        short |= (smaller < 1.0).any()
        if not short or step + 1 == easings + CORRECTIONS:
            break
        wanted = moves.wanted * np.clip(_widened(missing), 1.0, min(MOST_ADDED, ease))
        moves = _Moves(wanted, _eased(surface, moves.size, smaller), full, drop)
    return _Apart(moves, shares, layers, measured)


def _shares(task: _Task, moves: _Moves) -> list[tuple[Shares, ...]]:
    """Return how far the copies of each curve move along their rays on each layer, before they are drawn together."""
    surface, clearance = task.surface, task.clearance
    nearness = np.clip((clearance - task.depth[surface.curves]) / (CLOSE * clearance), 0.0, 1.0)
    levels = task.levels(moves.drop)
    outer, *under = [layer_shares(surface, points, task.down, clearance=moves.wanted) for points in levels]
    outer = unfolded(surface, surface.points, outer)
    under[0] = tuple(
        shares_near(above, own, nearness=near) for above, own, near in zip(outer, under[0], nearness, strict=True)
    )
    return [outer, *under]


def _laid(task: _Task, shares: Sequence[tuple[Shares, ...]], moves: _Moves) -> WallLayers:
    """Return the layers whose curves' copies have moved by these shares."""
    surface, joint, clearance = task.surface, task.joint, task.clearance
    levels = task.levels(moves.drop)
    shares = [tuple(map(_drawn_back, each, moves.drawn)) for each in shares]
    if joint.kind == "draft":
        full = asides(surface, task.inner, joint, clearance=clearance)
        eased = [share * aside for share, aside in zip(moves.size, full, strict=True)]
        under = zip(levels[1:], shares[1:], strict=True)
        shares = [shares[0], *(shares_aside(surface, *each, asides=eased) for each in under)]
    outer, lower, *floor = [layer(surface, *each) for each in zip(levels, shares, strict=True)]
    rings = ridges(surface, outer, lower, joint, size=moves.size, clearance=clearance)
    return WallLayers(outer, lower, rings, floor[0] if floor else None)


def _drawn_back(shares: Shares, drawn: Floats) -> Shares:
    return Shares(shares.left * drawn, shares.right * drawn)


def _drawn_together(surface: CutSurface, moves: _Moves, wide: Floats, least: Floats) -> _Moves:
    """Return moves that make the gap less wide where it is too wide, and keep the clearance.

    `wide` and `least`, (k, c), are the widest gap along the mid-line and the smallest one, in clearances. Where both
    cannot be had the joint gets smaller.
    """
    most, fewest = np.minimum(DRAWN / wide, 1.0), KEPT / np.maximum(least, 1e-9)
    too_wide = wide > WIDE
    factor = np.where(too_wide | (moves.drawn < 1.0), np.maximum(np.where(too_wide, most, 1.0), fewest), 1.0)
    size = _eased(surface, moves.size, np.where(too_wide & (fewest > most), EASIER, 1.0))
    return moves._replace(size=size, drawn=np.minimum(moves.drawn * factor, 1.0))


def _easier(missing: Floats, ease: float) -> Floats:
    """Return the shares, (k, c), by which a joint is to become smaller where more than `ease` is missing.

    What a joint takes of the gap falls with its size.
    """
    taken = 1.0 - 1.0 / np.maximum(missing, 1.0 + 1e-9)
    return np.where(missing > ease, np.clip((1.0 - 1.0 / ease) / taken, EASIER, 1.0), 1.0)


def _blunt(task: _Task, layers: WallLayers) -> Floats:
    """Return the shares, (k, c), by which a joint is to become smaller where the lips beside a groove are too blunt."""
    surface = task.surface
    if not layers.rings:
        return np.ones(surface.curves.shape)
    above, below = (vertex_normals(points, surface.triangles) for points in (surface.points, task.inner))
    down = layers.down(to_floor=False)
    steep = [
        lip_steepness(np.stack([each.copies[number + 1][curve] for each in down]), above[curve], -below[curve])
        for number, curve in enumerate(surface.curves)
    ]
    return np.clip(BLUNT / np.maximum(_widened(np.stack(steep)), 1e-9), EASIER, 1.0)


def _eased(surface: CutSurface, size: Floats, shares: Floats) -> Floats:
    """Return the size of a joint along each curve, (k, c), made smaller by shares, (k, c), and around them."""
    curves = zip(shares, surface.points[surface.curves], strict=True)
    return size * np.stack([tapered(each, curve, taper=EASED_TAPER) for each, curve in curves])


def _deeper(surface: CutSurface, layers: WallLayers, drop: Floats, *, keeper: int, clearance: float) -> Floats:
    """Return how far the floor has to lie below the inner points for the clearance under every other part, (n,) mm."""
    deeper = drop
    for region, ceiling in enumerate(layers.inner.copies):
        if region != keeper and layers.floor is not None:
            floor = layers.floor.copies[keeper]
            inlaid = surface.triangles[surface.regions == region]
            deeper = np.maximum(deeper, lowered(drop, ceiling, floor, inlaid, clearance=clearance))
    return deeper


def _measured(
    surface: CutSurface, layers: WallLayers, keeper: int | None, before: Sequence[WallGaps]
) -> list[WallGaps]:
    """Measure the walls along each curve, where they moved if they were before; only a core's goes to the floor."""

    def wall_edges(region: int, curve: Indices) -> list[Floats]:
        return [each.copies[region][curve] for each in layers.down(to_floor=region == keeper)]

    sides = [(wall_edges(number, curve), wall_edges(number + 1, curve)) for number, curve in enumerate(surface.curves)]
    if not before:
        return [WallGaps.of(*walls) for walls in sides]
    return [found.again(*walls) for found, walls in zip(before, sides, strict=True)]


def _smallest(measured: list[WallGaps]) -> Floats:
    """Return how far apart the walls are beside each curve point, (k, c) mm."""
    return np.stack([each.gaps for each in measured])


def _middle_gaps(surface: CutSurface, layers: WallLayers) -> Floats:
    """Return how far apart the walls are along their mid-line beside each curve point, (k, c), where it is most."""
    down = layers.down(to_floor=False)
    sides = [
        [[each.copies[number + side][curve] for each in down] for side in (0, 1)]
        for number, curve in enumerate(surface.curves)
    ]
    return np.stack([middle_gaps(left, right) for left, right in sides])


def _widened(values: Floats) -> Floats:
    """Return for each point of each curve, (k, c), the largest value among it and its neighbours."""
    widened: Floats = np.maximum.reduce([values, np.roll(values, 1, axis=1), np.roll(values, -1, axis=1)])
    return widened
