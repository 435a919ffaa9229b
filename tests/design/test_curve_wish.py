"""Wishes for the curve are values: equal if they ask for the same, and not edited."""

from dataclasses import FrozenInstanceError, replace

import pytest

from fabricate.design.curve_wish import CurveWish


def test_wishes_are_values() -> None:
    wish = CurveWish(tree="random", seed=1, rings=(0.5,), neck=1.0)
    assert replace(wish, seed=1) == wish != replace(wish, seed=2)
    with pytest.raises(FrozenInstanceError):
        wish.seed = 2  # type: ignore[misc]
