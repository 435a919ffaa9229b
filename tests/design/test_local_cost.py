"""Costs of single tiles."""

from __future__ import annotations

import numpy as np
from costs import assert_foretells
from hypothesis import given
from polyhedra import seeds
from truchet import any_states

from fabricate.design.local_cost import TileCost
from fabricate.duotone.duotone import Duotone


@given(duotone=any_states(), seed=seeds)
def test_it_is_the_sum_over_the_tiles(duotone: Duotone, seed: int) -> None:
    costs = np.random.default_rng(seed).normal(size=(len(duotone.joined), 2))

    def total(other: Duotone) -> float:
        return float(np.where(other.joined, costs[:, 0], costs[:, 1]).sum())

    assert_foretells(TileCost(costs, duotone.joined), duotone, total, seed=seed)
