"""The report of a coupon: what it says as JSON, in one line, and when it is ok."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from fabricate.checks.check import Check
from fabricate.checks.coupon_report import CouponReport, coupon_report_json, coupon_verdict
from fabricate.checks.facts import Gap
from fabricate.checks.judged_coupon import CouponPieceFacts, CouponPlaceFacts, JudgedCoupon

PLACE = CouponPlaceFacts("blue", (1.0, 2.0, 3.0), 1.9, 1.9, 10.0, 2.4)
PIECES = tuple(
    CouponPieceFacts(f"{clearance:.2f}", kind, clearance, 40.0, Gap(clearance, (0.0, 0.0, 0.0)), None)
    for clearance in (0.2, 0.3)
    for kind in ("neck", "bend")
)
PASSED = Check("coupon.closed", ok=True, message="closed")
FAILED = Check("coupon.flat", ok=False, message="one floats")
SKIPPED = Check("coupon.0.20.neck.gap", ok=False, skipped=True, message="not measured")
JUDGED = JudgedCoupon(100, (116.0, 38.0, 2.5), PLACE, PLACE, PIECES, (PASSED,))
REPORT = CouponReport("ring-coupon", "coupon.stl", "abc", {"numpy": "2"}, JUDGED, {"solids": 1.23456789})


def with_checks(*checks: Check) -> CouponReport:
    return replace(REPORT, judged=replace(JUDGED, checks=checks))


def test_it_is_ok_only_when_every_check_ran_and_passed() -> None:
    assert with_checks(PASSED).ok
    assert not with_checks(PASSED, FAILED).ok
    assert not with_checks(PASSED, SKIPPED).ok


def test_the_verdict_names_the_clearances_or_what_is_wrong() -> None:
    assert coupon_verdict(with_checks(PASSED)) == "ok, clearances of 0.20, 0.30 mm"
    assert coupon_verdict(with_checks(PASSED, FAILED, SKIPPED)) == "one floats; not measured"


def test_the_verdict_says_when_the_neck_is_not_the_narrowest() -> None:
    other = replace(REPORT, judged=replace(JUDGED, neck=replace(PLACE, size_mm=2.5)))
    assert "narrowest neck, 1.9 mm" in coupon_verdict(other)
    assert "one of 2.5 mm" in coupon_verdict(other)
    assert "note" not in coupon_verdict(REPORT)


def test_json_holds_places_pieces_and_checks() -> None:
    content = json.loads(coupon_report_json(with_checks(PASSED, FAILED)))
    assert (content["name"], content["ok"], content["config_sha256"]) == ("ring-coupon", False, "abc")
    assert content["coupon"] == {"file": "coupon.stl", "triangles": 100, "size_mm": [116.0, 38.0, 2.5]}
    assert content["places"]["neck"]["at"] == [1.0, 2.0, 3.0]
    assert [piece["gap_mm"]["min"] for piece in content["pieces"]] == [0.2, 0.2, 0.3, 0.3]
    assert [check["code"] for check in content["checks"]] == ["coupon.closed", "coupon.flat"]
    assert content["seconds"] == {"solids": 1.23457}


def test_mappings_are_read_only() -> None:
    with pytest.raises(TypeError):
        REPORT.seconds["solids"] = 2.0  # type: ignore[index]
