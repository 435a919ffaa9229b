"""Expectations: what is left open is filled in from the clearance, and nothing can be edited."""

from __future__ import annotations

import pytest

from fabricate.checks.expectations import Expectations


@pytest.mark.parametrize(("clearance", "verdict"), [(0.3, "captive"), (0.0, "fused"), (None, "captive")])
def test_parts_should_hold_together(clearance: float | None, verdict: str) -> None:
    assert Expectations(clearance=clearance).expected_verdict == verdict
    assert Expectations(clearance=clearance, verdict="separable").expected_verdict == "separable"


def test_later_changes_of_the_callers_mapping_do_not_count() -> None:
    genus = {"red": 1}
    made = Expectations(genus=genus)
    genus["red"] = 2
    assert made.genus == {"red": 1}
    with pytest.raises(TypeError):
        made.genus["red"] = 3  # type: ignore[index]
