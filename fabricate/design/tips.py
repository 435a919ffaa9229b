"""Tips: points at which a corridor ends."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.duotone.duotone import Duotone


def tip_count(duotone: Duotone) -> int:
    """Return the number of points, of either colour, that are joined to others across one tile only."""
    return int(np.count_nonzero(_degrees(duotone) == 1))


class TipCost:
    """`weight` for each tip; see `fabricate.design.local_cost`."""

    def __init__(self, duotone: Duotone, *, weight: float) -> None:
        self._tiles = duotone.quads.tiles
        self._degrees = _degrees(duotone)
        self._steps = np.where(duotone.joined[:, None], [-1, 1, -1, 1], [1, -1, 1, -1])
        self._weight = weight

    def changes(self, tiles: Indices) -> Floats:
        """Return by how much the cost would change if one of these tiles were flipped, for each of them."""
        now = self._degrees[self._tiles[tiles]]
        then = now + self._steps[tiles]
        change: Floats = self._weight * (np.count_nonzero(then == 1, axis=1) - np.count_nonzero(now == 1, axis=1))
        return change

    def flip(self, tile: int) -> None:
        """Take note that a tile is flipped."""
        self._degrees[self._tiles[tile]] += self._steps[tile]
        self._steps[tile] *= -1


def _degrees(duotone: Duotone) -> Indices:
    """Return across how many tiles each point is joined to others, (n,) int."""
    tiles, joined = duotone.quads.tiles, duotone.joined
    ends = np.concatenate([tiles[joined][:, [0, 2]].ravel(), tiles[~joined][:, [1, 3]].ravel()])
    return np.bincount(ends, minlength=len(duotone.quads.points))
