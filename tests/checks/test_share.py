"""The check of the area share."""

from __future__ import annotations

import pytest

from fabricate.checks.share import share_checks


def test_no_check_where_none_was_asked_for() -> None:
    assert share_checks(None, found=0.5) == ()


@pytest.mark.parametrize(("found", "ok"), [(0.6, True), (0.6009, True), (0.5991, True), (0.6012, False), (0.4, False)])
def test_it_holds_within_a_thousandth(found: float, ok: bool) -> None:
    (check,) = share_checks(0.6, found=found)
    assert (check.code, check.ok, check.skipped) == ("pattern.area_share", ok, False)
    assert f"{found:.5f}" in check.message
