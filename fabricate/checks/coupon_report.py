"""The report of a fit coupon, and its form in report.json."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from fabricate.checks.judged_coupon import JudgedCoupon
from fabricate.checks.report import json_value


@dataclass(frozen=True, eq=False)
class CouponReport:
    """What is known of a finished fit coupon.

    Attributes
    ----------
    name : str
        That of its folder.
    file : str
        Name of the STL file that was judged.
    config_sha256 : str
        Of the sculpture's resolved config.
    versions : mapping of str to str
        Version of each program that took part.
    judged : JudgedCoupon
    seconds : mapping of str to float
        Time that each stage took.
    """

    name: str
    file: str
    config_sha256: str
    versions: Mapping[str, str]
    judged: JudgedCoupon
    seconds: Mapping[str, float]

    def __post_init__(self) -> None:
        for name in ("versions", "seconds"):
            object.__setattr__(self, name, MappingProxyType(dict(getattr(self, name))))

    @property
    def ok(self) -> bool:
        """True when every check ran and passed: a gap that was not measured is no gap to go by."""
        return all(check.ok for check in self.judged.checks)


def coupon_verdict(report: CouponReport) -> str:
    """Return in one line what failed or was not measured, or which clearances are on the plate.

    If another neck than the narrowest is on it, that is said too.
    """
    judged = report.judged
    wrong = [check.message for check in judged.checks if not check.ok]
    labels = dict.fromkeys(piece.label for piece in judged.pieces)
    said = wrong or [f"ok, clearances of {', '.join(labels)} mm"]
    if judged.neck.size_mm > judged.neck.wanted_mm:
        said.append(
            f"note: the narrowest neck, {judged.neck.wanted_mm:.3g} mm, is too narrow for the largest clearance or "
            "lies where the surface bends too sharply for a flat back, "
            f"so that one of {judged.neck.size_mm:.3g} mm is shown"
        )
    return "; ".join(said)


def coupon_report_json(report: CouponReport) -> str:
    """Return the report as JSON text: six digits, a newline at the end."""
    judged = report.judged
    content = {
        "name": report.name,
        "ok": report.ok,
        "config_sha256": report.config_sha256,
        "versions": report.versions,
        "coupon": {"file": report.file, "triangles": judged.triangles, "size_mm": judged.size_mm},
        "places": {"neck": judged.neck, "bend": judged.bend},
        "pieces": judged.pieces,
        "checks": judged.checks,
        "seconds": report.seconds,
    }
    return json.dumps(json_value(content), indent=2, allow_nan=False, ensure_ascii=False) + "\n"
