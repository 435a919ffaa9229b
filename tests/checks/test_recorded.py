"""What a folder records: the report of a run, what it says of the design, and what is none."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from fabricate.checks.check import Check
from fabricate.checks.recorded import (
    Recorded,
    as_recorded,
    read_middles,
    read_report,
    recorded_checks,
    recorded_expectations,
)
from fabricate.config import Config
from fabricate.config.pattern_config import PatternConfig
from fabricate.config.source_config import CubeConfig
from fabricate.errors import ReadError
from fabricate.output.curve_ply import write_curves

PARTS = {name: {"file": f"{name}.stl", "volume_mm3": 5.0} for name in ("yellow", "band-1", "band-2", "blue")}
REPORT = {
    "name": "it",
    "config_sha256": "",
    "mesh": {"chord_mm": {"p99": 0.07}},
    "pattern": {
        "curves": 3,
        "handles": dict.fromkeys(PARTS, 0),
        "area_share": {"yellow": 0.3},
        "neck_mm": {"min": 2.5},
        "band_mm": {"band-1": {"min": 1.9}, "band-2": {"min": 1.5}},
    },
    "parts": PARTS,
    "fit": {"spaces_mm3": {"gap": 3.0, "shell": 23.0}},
    "checks": [{"code": "pattern.neck", "where": [[1, 2, 3]]}, {"code": "pattern.band", "where": [[4, 5, 6]]}],
    "joint": {"kind": "tongue", "lean_deg": 0.0, "ridge_mm": {"min": 0.3, "median": 0.4}, "width_mm": 1.0},
}
RECORDED = Recorded.model_validate(REPORT)


def config(**pattern: object) -> Config:
    return Config(source=CubeConfig(shape="cube"), pattern=PatternConfig.model_validate(pattern))


def test_what_the_report_says_of_the_design_is_expected() -> None:
    middles = np.arange(18.0).reshape(3, 2, 3)
    found = recorded_expectations(RECORDED, config(rings=(0.35, 0.5, 0.6)), clearance=0.25, middles=middles)
    assert found.clearance == 0.25
    assert found.neck == (2.5, (1.0, 2.0, 3.0))
    assert found.band == ("band-2", 1.5, (4.0, 5.0, 6.0), pytest.approx(0.1))
    assert found.spaces is not None
    assert (found.spaces.gap, found.spaces.shell, found.tolerance) == (3.0, 23.0, 0.07)
    assert list(found.middles) == ["yellow-band-1", "band-1-band-2", "band-2-blue"]


def test_ridge_and_area_share_are_judged_again() -> None:
    good = recorded_checks(RECORDED, config(area_share=0.3), clearance=0.3)
    bad = recorded_checks(RECORDED, config(area_share=0.4), clearance=0.5)
    assert [(check.code, check.ok) for check in good] == [("fit.ridge", True), ("pattern.area_share", True)]
    assert all(check.failed for check in bad)


def test_only_checks_that_ran_on_what_is_recorded_say_so() -> None:
    ran, measured = Check("pattern.neck", ok=True, message="good"), Check("fit.gap", ok=True, message="good")
    not_run = Check("fit.whole", ok=False, skipped=True, message="not known")
    found = [check.message for check in as_recorded([ran, measured, not_run])]
    assert found == ["good (widths as recorded in report.json)", "good", "not known"]


def test_places_on_the_mid_line_come_back_by_curve(tmp_path: Path) -> None:
    curves = [np.eye(3), 2 * np.eye(3)]
    write_curves(tmp_path / "curve.ply", curves, [curve[None] / 2 for curve in curves])
    found = read_middles(tmp_path / "curve.ply", curves=2)
    np.testing.assert_array_equal(found, [np.eye(3) / 2, np.eye(3)])
    with pytest.raises(ReadError, match="mid-line of 4 curves"):
        read_middles(tmp_path / "curve.ply", curves=4)


def test_the_folder_of_a_coupon_is_called_so(tmp_path: Path) -> None:
    (tmp_path / "report.json").write_text(json.dumps({"name": "it", "coupon": {}}))
    with pytest.raises(ReadError, match="folder of a fit coupon") as caught:
        read_report(tmp_path / "report.json")
    assert "\n" not in str(caught.value)
