"""Facts: plain values that cannot be edited and compare by what they hold."""

from __future__ import annotations

from dataclasses import FrozenInstanceError

import pytest

from fabricate.checks.facts import Gap, Spread


def test_equal_facts_are_equal() -> None:
    assert Spread(1.0, 2.0) == Spread(1.0, 2.0) != Spread(1.0, 2.5)
    assert Gap(0.3, (1.0, 2.0, 3.0)) == Gap(0.3, (1.0, 2.0, 3.0))


def test_facts_cannot_be_edited() -> None:
    with pytest.raises(FrozenInstanceError):
        Spread(1.0, 2.0).min = 3.0  # type: ignore[misc]
