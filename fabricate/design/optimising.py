"""A duotone made better: what is measured of it before and after, and the costs that lead the way."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from fabricate.arrays import Floats, Mask
from fabricate.design.annealing import annealed
from fabricate.design.corridor import CorridorCost, longest_corridor
from fabricate.design.evenness import EvennessCost, unevenness
from fabricate.design.local_cost import LocalCost, TileCost
from fabricate.design.tips import TipCost, tip_count
from fabricate.design.weights import Weights
from fabricate.duotone.duotone import Duotone
from fabricate.surface.neck import NeckGauge

SHARPNESS = 4
"""Power by which narrow necks count more than wide ones."""

NARROW = 10.0
"""What a tile without any neck costs, with all weights together for the unit."""

TOLD = 10
"""How often progress is told."""


@dataclass(frozen=True)
class Change:
    """The value of an objective before and after it was optimised."""

    before: float
    after: float


@dataclass(frozen=True, eq=False)
class Optimised:
    """A duotone made better.

    Attributes
    ----------
    duotone : Duotone
        The best that was met.
    objectives : mapping of str to Change
        "neck", the necks' power mean of exponent -4, mm; "evenness", see `unevenness`; "alignment", mean |cos|, where
        there are directions; "tips", how many; "corridor", the longest one in tiles.
    flips : int
        Pairs of tiles that were flipped on the way.
    tried : int
        Flips that were tried: fewer than were asked for if time ran out.
    """

    duotone: Duotone
    objectives: Mapping[str, Change]
    flips: int
    tried: int


def optimised(
    duotone: Duotone,
    weights: Weights,
    *,
    arc: float,
    neck: float,
    flips: int,
    seed: int,
    seconds: float | None = None,
    alignments: Floats | None = None,
    free: Mask | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Optimised:
    """Return the duotone after flips of interlaced tiles that make the weighted sum of objectives better.

    Both regions keep their handles. Tiles whose necks would become narrower than `neck` are kept from it as far as
    the tiles allow, whatever counts. The same arguments give the same duotone, unless time runs out. It may be
    interrupted at any time; nothing that is given is changed.

    Parameters
    ----------
    duotone : Duotone
        With one curve.
    weights : Weights
        How much each objective counts.
    arc : float
        Where the curve crosses tile sides, from their yellow ends.
    neck : float
        Narrowest neck that will do, mm, before clearance is taken off.
    flips : int
        Flips that are tried; about 20 for each tile are enough.
    seed : int
        Draws what is tried.
    seconds : float, optional
        Ends the search with the best so far when more time has passed.
    alignments : (t, 2) float, optional
        |cos| between the directions of a field and each tile's yellow and blue diagonal; see `alignment_costs`.
    free : (t,) bool, optional
        Tiles that may be flipped; all by default.
    progress : callable
        Is told ten times how far it is.

    Raises
    ------
    PatternError
        If the arc position is out of range or the duotone has more than one curve.
    """
    necks = NeckGauge.of(duotone.quads, arc=arc).necks(duotone.quads.points)
    tiles = len(duotone.joined)
    found = annealed(
        duotone,
        _local_costs(duotone, weights, necks, neck, alignments, arc),
        flips=flips,
        seed=seed,
        free=np.ones(tiles, dtype=bool) if free is None else free,
        whole=CorridorCost(duotone.quads, step=2.0 * weights.corridor) if weights.corridor else None,
        stopped=_watch(flips, seconds, progress),
    )
    before, after = (_measured(each, necks, alignments, arc) for each in (duotone, found.duotone))
    objectives = {name: Change(value, after[name]) for name, value in before.items()}
    return Optimised(found.duotone, objectives, found.made, found.tried)


def _local_costs(
    duotone: Duotone, weights: Weights, necks: Floats, neck: float, alignments: Floats | None, arc: float
) -> list[LocalCost]:
    """Return the costs that count, each about as large as the number of tiles when its weight is 1."""
    of_tiles = NARROW * weights.total * np.maximum(1.0 - necks / neck, 0.0)
    of_tiles += weights.neck * (np.median(necks) / necks) ** SHARPNESS
    if alignments is not None:
        of_tiles -= weights.alignment * alignments
    costs: list[LocalCost] = [TileCost(of_tiles, duotone.joined)]
    if weights.tips:
        costs.append(TipCost(duotone, weight=weights.tips))
    if weights.evenness:
        costs.append(EvennessCost(duotone, arc=arc, weight=weights.evenness))
    return costs


def _measured(duotone: Duotone, necks: Floats, alignments: Floats | None, arc: float) -> dict[str, float]:
    """Return the value of each objective."""
    joined = duotone.joined
    inverse = np.where(joined, necks[:, 0], necks[:, 1]) ** -float(SHARPNESS)
    values = {"neck": float(inverse.mean() ** (-1.0 / SHARPNESS)), "evenness": unevenness(duotone, arc=arc)}
    if alignments is not None:
        directed = alignments.any(axis=1)
        followed = np.where(joined, alignments[:, 0], alignments[:, 1])[directed]
        values["alignment"] = float(followed.mean()) if len(followed) else 0.0
    return {**values, "tips": float(tip_count(duotone)), "corridor": float(longest_corridor(duotone))}


def _watch(flips: int, seconds: float | None, progress: Callable[[str], None]) -> Callable[[int], bool]:
    """Return a function that tells of progress and says whether time is up, for the number of tries so far."""
    begin, every = perf_counter(), max(1, flips // TOLD)

    def stopped(tried: int) -> bool:
        if tried % every == 0:
            progress(f"optimising: {tried} of {flips} flips tried")
        return seconds is not None and perf_counter() - begin >= seconds

    return stopped
