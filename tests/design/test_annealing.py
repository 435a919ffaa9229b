"""Annealing: one curve throughout, handles and locks kept, and as good as can be where that is known."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from polyhedra import HANDLES, seeds
from truchet import quasi_trees

from fabricate.arrays import Mask
from fabricate.design.annealing import annealed
from fabricate.design.local_cost import TileCost
from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.certificate import certified
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.handles import with_handles
from fabricate.duotone.spanning_tree import random_duotone, weighted_duotone
from fabricate.errors import PatternError
from fabricate.mesh.sphere import geodesic_sphere

SPHERE = subdivided(geodesic_sphere(frequency=3), levels=1)
COSTS = np.random.default_rng(8).random((len(SPHERE.tiles), 2))
EVERY = np.ones(len(SPHERE.tiles), dtype=bool)


def total(duotone: Duotone, costs: np.ndarray = COSTS) -> float:
    return float(np.where(duotone.joined, costs[:, 0], costs[:, 1]).sum())


class YellowOnTop:
    """A whole cost with a known optimum: joined tiles among the first hundred."""

    step = 1.0

    def of(self, joined: Mask) -> float:
        return -float(joined[:100].sum())


def test_on_a_sphere_it_finds_the_best_of_all_trees() -> None:
    # every single curve on a sphere is a tree, and the cheapest tree is known
    best = total(weighted_duotone(SPHERE, COSTS[:, 0] - COSTS[:, 1]))
    duotone = random_duotone(SPHERE, seed=1)
    found = annealed(duotone, [TileCost(COSTS, duotone.joined)], flips=6000, seed=2, free=EVERY)
    assert best - 1e-9 <= total(found.duotone) < best + 0.01 * (total(duotone) - best)
    assert certified(found.duotone).holds


@settings(max_examples=25)
@given(duotone=quasi_trees(), seed=seeds)
def test_handles_and_locks_stay_and_nothing_gets_worse(duotone: Duotone, seed: int) -> None:
    rng = np.random.default_rng(seed)
    costs, free = rng.normal(size=(len(duotone.joined), 2)), rng.random(len(duotone.joined)) < 0.7
    found = annealed(duotone, [TileCost(costs, duotone.joined)], flips=100, seed=seed, free=free).duotone
    assert certified(found) == certified(duotone)
    assert np.array_equal(found.joined[~free], duotone.joined[~free])
    assert total(found, costs) <= total(duotone, costs) + 1e-9


def test_handles_of_both_regions_are_kept() -> None:
    tree = random_duotone(subdivided(HANDLES["genus six"][0], levels=1), seed=1)
    duotone = with_handles(tree, yellow=2, seed=1)
    costs = np.random.default_rng(3).random((len(duotone.joined), 2))
    every = np.ones(len(costs), dtype=bool)
    found = annealed(duotone, [TileCost(costs, duotone.joined)], flips=3000, seed=2, free=every)
    proof = certified(found.duotone)
    assert proof.holds
    assert (proof.yellow.handles, proof.blue.handles) == (2, 4)
    assert total(found.duotone, costs) < 0.9 * total(duotone, costs)


def test_costs_of_the_whole_count_as_well() -> None:
    duotone = random_duotone(SPHERE, seed=1)
    found = annealed(duotone, [], flips=2000, seed=2, free=EVERY, whole=YellowOnTop()).duotone
    cheapest = weighted_duotone(SPHERE, np.where(np.arange(len(EVERY)) < 100, 0.0, 1.0))
    assert YellowOnTop().of(found.joined) == YellowOnTop().of(cheapest.joined) < YellowOnTop().of(duotone.joined)
    assert certified(found).holds


def test_seeds_differ_and_repeat() -> None:
    duotone = random_duotone(SPHERE, seed=1)
    first, again, other = (
        annealed(duotone, [TileCost(COSTS, duotone.joined)], flips=300, seed=seed, free=EVERY).duotone.joined
        for seed in (1, 1, 2)
    )
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def test_it_stops_when_told_with_the_best_so_far() -> None:
    duotone = random_duotone(SPHERE, seed=1)
    found = annealed(
        duotone, [TileCost(COSTS, duotone.joined)], flips=6000, seed=2, free=EVERY, stopped=lambda tried: tried == 50
    )
    assert found.tried == 50
    assert found.made <= 50
    assert total(found.duotone) <= total(duotone)


def test_an_interruption_leaves_what_was_given_as_it_was() -> None:
    duotone = random_duotone(SPHERE, seed=1)
    before = duotone.joined.copy()

    def interrupt(tried: int) -> bool:
        if tried == 20:
            raise KeyboardInterrupt
        return False

    with pytest.raises(KeyboardInterrupt):
        annealed(duotone, [TileCost(COSTS, before)], flips=60, seed=2, free=EVERY, stopped=interrupt)
    assert np.array_equal(duotone.joined, before)


def test_without_free_tiles_nothing_is_tried() -> None:
    duotone = random_duotone(SPHERE, seed=1)
    found = annealed(duotone, [TileCost(COSTS, duotone.joined)], flips=60, seed=2, free=~EVERY)
    assert (found.tried, found.made) == (0, 0)
    assert np.array_equal(found.duotone.joined, duotone.joined)


def test_several_curves_are_refused() -> None:
    with pytest.raises(PatternError, match="expected one closed curve"):
        annealed(Duotone(SPHERE, EVERY), [], flips=1, seed=0, free=EVERY)
