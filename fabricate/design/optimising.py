"""A duotone made better: what is measured of it before and after, and the costs that lead the way."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from fabricate.arrays import Floats, Mask
from fabricate.config.optimise_config import OptimiseConfig
from fabricate.design.annealing import Annealed, annealed
from fabricate.design.corridor import CorridorCost, longest_corridor
from fabricate.design.evenness import EvennessCost, unevenness
from fabricate.design.local_cost import LocalCost, TileCost
from fabricate.design.tips import TipCost, tip_count
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
    notes : tuple of str
        That time ran out, if it did.
    """

    duotone: Duotone
    objectives: Mapping[str, Change]
    notes: tuple[str, ...]


def optimised(
    duotone: Duotone,
    asked: OptimiseConfig,
    *,
    rings: Sequence[float],
    neck: float,
    seed: int,
    alignments: Floats | None = None,
    across: bool = False,
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
    asked : OptimiseConfig
        How much each objective counts, and how long it may take. The costs that are weighed are about as large as
        the number of tiles; where weights are equal, objectives are about equally strong.
    rings : sequence of float
        Where the curves cross tile sides, from their yellow ends; yellow ends at the first.
    neck : float
        Narrowest neck that will do, mm, before clearance is taken off.
    seed : int
        Draws what is tried.
    alignments : (t, 2) float, optional
        |cos| between the directions of a field and each tile's yellow and blue diagonal; see `alignment_costs`.
    across : bool
        Whether alignment is optimised across these directions, and not along them.
    free : (t,) bool, optional
        Tiles that may be flipped; all by default.
    progress : callable
        Is told ten times how far it is.

    Raises
    ------
    PatternError
        If the positions of the arcs are out of range or do not increase, or the duotone has more than one curve.
    """
    necks = NeckGauge.of(duotone.quads, rings=rings).necks(duotone.quads.points)
    costs = _tile_costs(asked, necks, neck, alignments, across)
    found = annealed(
        duotone,
        _local_costs(duotone, asked, costs, rings[0]),
        flips=asked.flips,
        seed=seed,
        free=np.ones(len(costs), dtype=bool) if free is None else free,
        whole=CorridorCost(duotone.quads, step=2.0 * asked.corridor) if asked.corridor else None,
        stopped=_watch(asked, progress),
    )
    before, after = (_measured(each, necks, alignments, rings[0]) for each in (duotone, found.duotone))
    objectives = {name: Change(value, after[name]) for name, value in before.items()}
    return Optimised(found.duotone, objectives, _notes(found, asked))


def _tile_costs(asked: OptimiseConfig, necks: Floats, neck: float, alignments: Floats | None, across: bool) -> Floats:
    """Return what each tile costs yellow-joined and blue-joined, (t, 2) float."""
    costs: Floats = NARROW * asked.total * np.maximum(1.0 - necks / neck, 0.0)
    costs += asked.neck * (np.median(necks) / necks) ** SHARPNESS
    if alignments is not None:
        costs += (asked.alignment if across else -asked.alignment) * alignments
    return costs


def _local_costs(duotone: Duotone, asked: OptimiseConfig, of_tiles: Floats, arc: float) -> list[LocalCost]:
    costs: list[LocalCost] = [TileCost(of_tiles, duotone.joined)]
    if asked.tips:
        costs.append(TipCost(duotone, weight=asked.tips))
    if asked.evenness:
        costs.append(EvennessCost(duotone, arc=arc, weight=asked.evenness))
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


def _watch(asked: OptimiseConfig, progress: Callable[[str], None]) -> Callable[[int], bool]:
    """Return a function that tells of progress and says whether time is up, for the number of tries so far."""
    begin, every = perf_counter(), max(1, asked.flips // TOLD)

    def stopped(tried: int) -> bool:
        if tried % every == 0:
            progress(f"optimising: {tried} of {asked.flips} flips tried")
        return asked.seconds is not None and perf_counter() - begin >= asked.seconds

    return stopped


def _notes(found: Annealed, asked: OptimiseConfig) -> tuple[str, ...]:
    if found.tried == asked.flips or asked.seconds is None:
        return ()
    return (
        f"optimising ended after {found.tried} of {asked.flips} flips, when {asked.seconds:g} s were over: "
        "another run may give another curve",
    )
