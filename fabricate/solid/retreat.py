"""The retreat: where nothing else cures a fault, inner points go back until they lie right under the outer ones.

Every inner point has a path of its own: straight from where it was proposed to a safe place, straight into the body
under its part's own copy of the outer surface, and so near to it that walls and inner surfaces are as free of crossings
as that copy is, and facing walls as far apart as copies are. Outer points go along, from where the walls' corrections
moved them to where copies were seen to be apart (see `solid.spacing`). So whatever is wrong near a point is cured
somewhere on the way, and there is an end.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from scipy.sparse import csr_array

from fabricate.arrays import Floats, Indices, Mask, frozen
from fabricate.solid.assembly import Assembly
from fabricate.solid.inset import downward, straight_down
from fabricate.surface.cut import CutSurface
from fabricate.surface.embedding import stored
from fabricate.triangles.adjacency import grown

SAFE_DEPTH = 0.002
"""The safe depth, as a share of the thickness: so little that a surface that is embedded stays so."""

KEPT = (1.0, 0.6, 0.36, 0.2, 0.1, 0.04, 0.0)
"""How much of the way from the safe place to the proposed one is left after so many steps."""

HALVINGS = 6
"""How often the safe depth is halved in the steps after these, as slivers need."""

LAST = len(KEPT) - 1 + HALVINGS
"""Number of the last step."""

ROUNDINGS = 4.0
"""No safe place is nearer to the outer surface than so many steps of the numbers in a file, far from the origin."""

RINGS = 3
"""How far around the points that take a step others take a part of one, in edges."""


@dataclass(frozen=True, eq=False)
class Retreat:
    """An assembly as it was proposed, and the paths on which its inner points go back.

    Attributes
    ----------
    proposed : Assembly
    outer : (b, n, 3) float
        Where outer points end: each copy of the surface's points, mm.
    under : (b, n, 3) float
        From these to the safe places under them, mm.
    inner : (m, 3) int
        The inner surface, outward, by surface points.
    keeper : int or None
        The region that keeps the inside, down to a floor under all others.
    nearest : float
        Least share of the ways under the outer points that is left after all halvings.
    """

    proposed: Assembly
    outer: Floats
    under: Floats
    inner: Indices
    keeper: int | None
    nearest: float

    def __post_init__(self) -> None:
        for name in ("outer", "under"):
            shape = (None, self.proposed.surface_points, 3)
            object.__setattr__(self, name, frozen(getattr(self, name), np.float64, shape))

    @classmethod
    def of(
        cls,
        surface: CutSurface,
        proposed: Assembly,
        copies: Sequence[Floats],
        *,
        thickness: float,
        keeper: int | None,
    ) -> Retreat:
        """Find the safe places, at a small share of the thickness, mm, under the regions' outer copies, (n, 3) each."""
        outer = _outer(_blocks(proposed), len(copies) + 1 if len(proposed.gap) else 1).copy()
        straight = straight_down(surface.points, surface.triangles)
        ways = np.repeat(straight[None], len(outer), axis=0)
        for region, copy in enumerate(copies):
            own = surface.triangles[surface.regions == region]
            numbers = np.unique(own)
            outer[region] = copy
            ways[region, numbers] = downward(copy, own, straight)[numbers]
        least = ROUNDINGS * float(np.spacing(np.float32(np.abs(surface.points).max())))
        depth = max(SAFE_DEPTH * thickness, least)
        return cls(proposed, outer, depth * ways, surface.triangles, keeper, least / depth)

    def after(self, steps: Floats) -> Assembly:
        """Return the assembly when each inner point has taken so many steps, (n,) float from 0 to `LAST`.

        A floor goes up where everything around is so far back: it keeps its distance from what is over it.
        """
        proposed = _blocks(self.proposed)
        blocks, sides = proposed.copy(), len(self.outer)
        on_paths = partial(_on_paths, steps=steps, nearest=self.nearest)
        _outer(blocks, sides)[:] = on_paths(_outer(proposed, sides), self.outer, np.zeros_like(self.under))
        _inner(blocks, sides)[:] = on_paths(_inner(proposed, sides), self.outer, self.under)
        rings = _rings(proposed, self.proposed, sides)
        for number, (ring, new) in enumerate(zip(rings, _rings(blocks, self.proposed, sides), strict=True), start=1):
            outer, under = self.outer[: len(ring)], self.under[: len(ring)]
            new[:] = on_paths(ring, outer, number / (len(rings) + 1) * under)
        if len(blocks) > 2 * sides + sum(map(len, rings)) and self.keeper is not None:
            inner, ends = _inner(proposed, sides)[self.keeper], (self.outer[self.keeper], self.under[self.keeper])
            blocks[-1] = proposed[-1] + on_paths(inner, *ends, steps=_least_around(steps, self.inner)) - inner
        return replace(self.proposed, points=stored(blocks.reshape(-1, 3)))


def _on_paths(proposed: Floats, outer: Floats, under: Floats, *, steps: Floats, nearest: float) -> Floats:
    """Return where points are, (..., n, 3) mm, after so many steps, (n,), on their ways from the proposed places."""
    gone = 1.0 - np.interp(steps, np.arange(len(KEPT)), KEPT)[:, None]
    share = np.maximum(0.5 ** np.maximum(steps - (len(KEPT) - 1), 0.0), nearest)
    safe = outer + share[:, None] * under
    places: Floats = proposed + gone * (safe - proposed)
    return places


def _least_around(values: Floats, triangles: Indices) -> Floats:
    """Return the least value, (n,), among each point and its neighbours on a closed mesh."""
    least = values.copy()
    for k in range(3):
        np.minimum.at(least, triangles[:, k], values[triangles[:, k - 1]])
    return least


def _blocks(made: Assembly) -> Floats:
    """Return the points block by block: outer and inner copies by region and those of the whole, rings, and a floor."""
    return made.points.reshape(-1, made.surface_points, 3)


def _outer(blocks: Floats, sides: int) -> Floats:
    return blocks[0 : 2 * sides : 2]


def _inner(blocks: Floats, sides: int) -> Floats:
    return blocks[1 : 2 * sides : 2]


def _rings(blocks: Floats, made: Assembly, sides: int) -> list[Floats]:
    """Return the rings of all walls between the outer and the inner copies, from the outside in."""
    each = max(sides - 1, 1)
    begins = 2 * sides + each * np.arange(len(made.levels[0]) - 2)
    return [blocks[begin : begin + each] for begin in begins]


def stepping(faulty: Mask, means: csr_array) -> Floats:
    """Return how much of a step points take for the faulty ones, (n,) float: these and their neighbours a whole one."""
    weight = grown(faulty, means, 1).astype(np.float64)
    for _ in range(RINGS):
        weight = np.maximum(weight, means @ weight)
    return weight


def receded(retreat: Retreat, faults: Callable[[Assembly, Mask], Mask], means: csr_array, *, faulty: Mask) -> Assembly:
    """Return the assembly with inner points gone back as far as it takes until nothing is faulty.

    `faults` tells of an assembly which surface points something is wrong at, looking near those that moved, (n,) bool
    both; at first it is at the `faulty` ones. What is still wrong at the end of all paths is wrong with the surface
    itself.
    """
    made, steps = retreat.proposed, np.zeros(retreat.proposed.surface_points)
    while (steps[faulty] < LAST).any():
        steps = np.minimum(steps + stepping(faulty & (steps < LAST), means), LAST)
        before, made = made, retreat.after(steps)
        faulty = faults(made, made.moved_since(before))
    return made
