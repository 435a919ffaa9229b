"""Weights of objectives."""

from fabricate.design.weights import Weights


def test_nothing_counts_unless_asked() -> None:
    assert Weights().total == 0


def test_total_counts_what_is_asked_the_other_way_round_too() -> None:
    assert Weights(neck=1, tips=-2).total == 3
