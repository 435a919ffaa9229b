"""What a cost has to tell so that flips of tiles can be tried quickly; and the simplest, one number per tile."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from fabricate.arrays import Floats, Indices, Mask


class LocalCost(Protocol):
    """A cost that changes by little work when a tile is flipped; it remembers the states of the tiles."""

    def changes(self, tiles: Indices) -> Floats:
        """Return by how much the cost would change if one of these tiles were flipped, for each of them."""

    def flip(self, tile: int) -> None:
        """Take note that a tile is flipped."""


class TileCost:
    """The sum of what each tile costs as it is joined: `costs`, (t, 2) float, yellow-joined and blue-joined."""

    def __init__(self, costs: Floats, joined: Mask) -> None:
        self._swing = np.where(joined, costs[:, 1] - costs[:, 0], costs[:, 0] - costs[:, 1])

    def changes(self, tiles: Indices) -> Floats:
        """Return by how much the cost would change if one of these tiles were flipped, for each of them."""
        swing: Floats = self._swing[tiles]
        return swing

    def flip(self, tile: int) -> None:
        """Take note that a tile is flipped."""
        self._swing[tile] *= -1.0
