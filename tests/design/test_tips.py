"""Tips: ends of corridors of either colour."""

from __future__ import annotations

from costs import assert_foretells
from hypothesis import given
from polyhedra import seeds
from truchet import any_states, joined_graph, quasi_trees

from fabricate.design.tips import TipCost, tip_count
from fabricate.duotone.duotone import Duotone


@given(duotone=any_states())
def test_tips_are_the_leaves_of_both_graphs(duotone: Duotone) -> None:
    degrees = [degree for first in (0, 1) for _, degree in joined_graph(duotone, first=first).degree()]
    assert tip_count(duotone) == degrees.count(1)


@given(duotone=quasi_trees(), seed=seeds)
def test_changes_are_foretold(duotone: Duotone, seed: int) -> None:
    assert_foretells(TipCost(duotone, weight=0.7), duotone, lambda other: 0.7 * tip_count(other), seed=seed)
