"""What every cost of flips owes: the change that it foretells is the one that happens."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from fabricate.design.local_cost import LocalCost
from fabricate.duotone.duotone import Duotone


def assert_foretells(cost: LocalCost, duotone: Duotone, total: Callable[[Duotone], float], *, seed: int) -> None:
    """Flip tiles one after the other, any of them, and compare the changes with totals that are computed anew."""
    rng, joined = np.random.default_rng(seed), duotone.joined.copy()
    before = total(duotone)
    for _ in range(12):
        tiles = rng.permutation(len(joined))[:4]
        foretold = cost.changes(tiles)
        for tile, change in zip(tiles.tolist(), foretold.tolist(), strict=True):
            other = joined.copy()
            other[tile] ^= True
            np.testing.assert_allclose(total(Duotone(duotone.quads, other)) - before, change, rtol=1e-7, atol=1e-9)
        cost.flip(int(tiles[0]))
        joined[tiles[0]] ^= True
        before = total(Duotone(duotone.quads, joined))
