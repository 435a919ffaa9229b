"""One check: passed, failed or skipped, never two of them, and a bounded list of places."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.checks.check import MOST_PLACES, Check


@pytest.mark.parametrize(
    ("ok", "skipped", "failed"), [(True, False, False), (False, False, True), (False, True, False)]
)
def test_only_what_ran_can_fail(ok: bool, skipped: bool, failed: bool) -> None:
    assert Check("red.closed", ok=ok, skipped=skipped, message="").failed is failed


def test_places_are_few_and_read_only() -> None:
    check = Check("red.closed", ok=False, message="", where=np.zeros((1000, 3)))
    assert check.where.shape == (MOST_PLACES, 3)
    with pytest.raises(ValueError, match="read-only"):
        check.where[0, 0] = 1.0
    assert Check("red.closed", ok=True, message="").where.shape == (0, 3)
