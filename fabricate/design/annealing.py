"""Simulated annealing of a duotone: flips of interlaced tiles, from wild to careful."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.design.local_cost import LocalCost
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.flipping import FlippingCurve

COOLED = 1e-3
"""The last temperature as a share of the first."""

LEAST = 1e-9
"""Sums that are carried along must have become smaller by more than this to be called better."""


class WholeCost(Protocol):
    """A cost of all tiles together that has to be computed anew for every flip."""

    step: float

    def of(self, joined: Mask) -> float:
        """Return the cost of tiles in these states, (t,) bool; `step` is how much a flip changes it about."""


class Annealed(NamedTuple):
    """The best duotone that was met, and how many flips were tried and made on the way.

    `tried` is smaller than what was asked for where it was stopped.
    """

    duotone: Duotone
    tried: int
    made: int


def annealed(
    duotone: Duotone,
    costs: Sequence[LocalCost],
    *,
    flips: int,
    seed: int,
    free: Mask,
    whole: WholeCost | None = None,
    stopped: Callable[[int], bool] = lambda _: False,
) -> Annealed:
    """Return a duotone of less cost that has the same handles, by flips of interlaced tiles.

    Every try draws a tile and looks at all flips of it with an interlaced tile in the other state, which keep one
    curve and both regions' handles. One of them, or to stay, is chosen by the Boltzmann distribution of what
    they would cost (a heat bath). The temperature falls geometrically from the mean change that a tile makes.

    Source: Kirkpatrick, Gelatt and Vecchi, Science 220, 1983.

    Parameters
    ----------
    duotone : Duotone
        With one curve.
    costs : sequence of LocalCost
        Of this duotone; they are used up.
    flips : int
        How many flips are tried.
    seed : int
        Draws tiles and choices.
    free : (t,) bool
        Tiles that may be flipped.
    whole : WholeCost, optional
        Computed for each flip that the other costs allow, which is then taken or not by Metropolis' rule.
    stopped : callable
        Is told before every try how many there were, and ends the search by returning True.

    Raises
    ------
    PatternError
        If the duotone has more than one curve.
    """
    search = _Search(duotone, costs, free, whole, np.random.default_rng(seed))
    begin, tried = search.temperature(), 0
    while tried < flips and len(search.tiles) and not stopped(tried):
        search.step(begin * COOLED ** (tried / flips))
        tried += 1
    return Annealed(Duotone(duotone.quads, search.best), tried, search.made)


class _Search:
    """Where the annealing is, and the best it has met."""

    def __init__(
        self,
        duotone: Duotone,
        costs: Sequence[LocalCost],
        free: Mask,
        whole: WholeCost | None,
        rng: np.random.Generator,
    ) -> None:
        self.tiles: Indices = np.flatnonzero(free)
        self.best: Mask = duotone.joined
        self.made = 0
        self._curve = FlippingCurve(duotone)
        self._costs, self._free, self._whole, self._rng = costs, free, whole, rng
        self._above_best = 0.0
        self._of_whole = 0.0 if whole is None else whole.of(duotone.joined)

    def temperature(self) -> float:
        """Return the mean change of all costs by the flip of one tile."""
        of_whole = 0.0 if self._whole is None else abs(self._whole.step)
        return of_whole + float(np.abs(self._changes(self.tiles)).mean()) if len(self.tiles) else 0.0

    def step(self, temperature: float) -> None:
        """Try the flips of one tile."""
        first = int(self.tiles[self._rng.integers(len(self.tiles))])
        seconds = self._curve.partners(first)
        seconds = seconds[self._free[seconds] & (self._curve.joined[seconds] != self._curve.joined[first])]
        if len(seconds) == 0:
            return
        change = self._changes(np.array([first]))
        self._take_note(first)
        changes = change + self._changes(seconds)
        chosen = self._chosen(np.append(changes, 0.0), temperature)
        if chosen == len(seconds) or not self._flipped(first, int(seconds[chosen]), changes[chosen], temperature):
            self._take_note(first)
            return
        self._take_note(int(seconds[chosen]))
        self.made += 1

    def _flipped(self, first: int, second: int, change: float, temperature: float) -> bool:
        """Flip two tiles, unless the cost of the whole speaks against it; keep the states if they are the best."""
        self._curve.flip(first, second)
        if self._whole is not None:
            of_whole = self._whole.of(self._curve.joined)
            if of_whole - self._of_whole > temperature * self._rng.exponential():
                self._curve.flip(first, second)
                return False
            change, self._of_whole = change + of_whole - self._of_whole, of_whole
        self._above_best += change
        if self._above_best < -LEAST:
            self.best, self._above_best = self._curve.joined.copy(), 0.0
        return True

    def _chosen(self, changes: Floats, temperature: float) -> int:
        """Draw from the Boltzmann distribution: the least of the changes, each with Gumbel noise."""
        return int((changes - temperature * self._rng.gumbel(size=len(changes))).argmin())

    def _changes(self, tiles: Indices) -> Floats:
        return sum((cost.changes(tiles) for cost in self._costs), np.zeros(len(tiles)))

    def _take_note(self, tile: int) -> None:
        for cost in self._costs:
            cost.flip(tile)
