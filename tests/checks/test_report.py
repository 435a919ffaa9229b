"""The report: the contract's keys, numbers that JSON can hold, and when it is ok."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.checks.check import Check
from fabricate.checks.facts import (
    FitFacts,
    Gap,
    MeshFacts,
    PairFacts,
    PartFacts,
    PatternFacts,
    Play,
    Spaces,
    Spread,
    Witness,
)
from fabricate.checks.report import Report, report_json
from fabricate.prepare.tile_quality import TileQuality

PASSED = Check("red.closed", ok=True, message="closed")
SKIPPED = Check("fit.gap", ok=False, skipped=True, message="not known")
FAILED = Check("red.volume", ok=False, message="inside out", where=np.array([[1.23456789, 2.0, -3.0]]))
WITNESS = Witness(((1.0, 2.0, 3.0),), ((0.0, 0.0, 1.0),))
PART = PartFacts(
    file="red.stl",
    triangles=12,
    volume_mm3=1.0,
    area_mm2=6.0,
    genus=0,
    components=1,
    watertight=True,
    self_intersections=0,
    wall_mm=Spread(1.0, 1.5),
    neck_mm=None,
)


def report(
    checks: tuple[Check, ...] = (PASSED,),
    *,
    seconds: float = 0.5,
    gap: Gap | None = None,
    play: Play | None = None,
) -> Report:
    return Report(
        name="torus",
        config_sha256="abc",
        versions={"fabricate": "0.1.0", "numpy": "2"},
        mesh=MeshFacts(8, 6, 0, (10.0, 20.0, 30.0), {"faces flipped": 2}, (), None, None),
        pattern=PatternFacts(
            tiles=24,
            tile_size_mm=7.0,
            tile_quality=TileQuality(1.2, 1.5, 1.9, 1.4, ()),
            curves=1,
            regions=2,
            curve_length_mm=123.456789,
            arc=0.5,
            area_share={"yellow": 0.49, "blue": 0.51},
            handles={"yellow": 0, "blue": 1},
            neck_mm=Spread(1.1, 2.2),
            band_mm={},
        ),
        parts={"red": PART},
        fit=FitFacts(
            *(0.3, gap, 0.0, "captive", play, WITNESS),
            {"red-blue": PairFacts(gap, 0.0, "captive", None, None)},
            Spaces(12.0, 345.0),
        ),
        checks=checks,
        seconds={"read": seconds},
    )


def content(made: Report) -> Any:
    def refused(word: str) -> None:
        raise AssertionError(f"{word} is not JSON")

    return json.loads(report_json(made), parse_constant=refused)


def test_keys_are_those_of_the_contract() -> None:
    found = content(
        report(gap=Gap(0.29, (1.0, 2.0, 3.0), 0.2901, 0.31, (4.0, 5.0, 6.0)), play=Play(0.6, 0.6, 0.6, 1.0, 2.0, 3.0))
    )
    assert list(found) == [
        "name", "ok", "config_sha256", "versions", "mesh", "pattern", "parts", "finish", "joint", "fit", "wire",
        "checks", "seconds",
    ]  # fmt: skip
    assert found["mesh"] == {
        "vertices": 8, "faces": 6, "genus": 0, "size_mm": [10, 20, 30],
        "repairs": {"faces flipped": 2}, "notes": [], "chord_mm": None, "distance_mm": None,
    }  # fmt: skip
    assert set(found["pattern"]) >= {
        "tiles", "curves", "regions", "curve_length_mm", "arc", "area_share", "handles", "neck_mm",
    }  # fmt: skip
    assert found["pattern"]["area_share"] == {"yellow": 0.49, "blue": 0.51}
    assert found["pattern"]["handles"] == {"yellow": 0, "blue": 1}
    assert found["pattern"]["neck_mm"] == {"min": 1.1, "median": 2.2}
    assert list(found["parts"]["red"]) == [
        "file", "triangles", "volume_mm3", "area_mm2", "genus", "components", "watertight",
        "self_intersections", "wall_mm", "neck_mm",
    ]  # fmt: skip
    assert found["fit"] == {
        "clearance_mm": 0.3,
        "gap_mm": {"min": 0.29, "at": [1, 2, 3], "queried": 0.2901, "max": 0.31, "max_at": [4, 5, 6]},
        "overlap_mm3": 0,
        "verdict": "captive",
        "play_mm": {"x": 0.6, "y": 0.6, "z": 0.6, "rx": 1, "ry": 2, "rz": 3},
        "witness": {"points": [[1, 2, 3]], "normals": [[0, 0, 1]]},
        "pairs": {
            "red-blue": {
                "gap_mm": {"min": 0.29, "at": [1, 2, 3], "queried": 0.2901, "max": 0.31, "max_at": [4, 5, 6]},
                "overlap_mm3": 0,
                "verdict": "captive",
                "play_mm": None,
                "witness": None,
            }
        },
        "spaces_mm3": {"gap": 12, "shell": 345},
    }
    assert found["seconds"] == {"read": 0.5}


def test_checks_are_written_with_their_places() -> None:
    passed, failed = content(report((PASSED, FAILED)))["checks"]
    assert passed == {"code": "red.closed", "ok": True, "skipped": False, "message": "closed", "where": []}
    assert failed == {
        "code": "red.volume",
        "ok": False,
        "skipped": False,
        "message": "inside out",
        "where": [[1.23457, 2, -3]],
    }


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf])
def test_numbers_that_json_has_no_word_for_become_null(number: float) -> None:
    found = content(report(seconds=number, gap=Gap(number, None), play=Play(0.6, 0.6, number, 1, 1, 1)))
    assert found["seconds"] == {"read": None}
    assert found["fit"]["gap_mm"] == {"min": None, "at": None, "queried": None, "max": None, "max_at": None}
    assert found["fit"]["play_mm"]["z"] is None


def test_what_is_not_known_is_null() -> None:
    made = Report("cube", "", {}, None, None, {}, None, (PASSED,))
    found = content(made)
    assert (found["mesh"], found["pattern"], found["fit"]) == (None, None, None)
    assert (found["parts"], found["seconds"]) == ({}, {})


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_keep_six_digits(number: float) -> None:
    found = content(report(seconds=number))["seconds"]["read"]
    assert found == pytest.approx(number, rel=1e-5)
    assert float(f"{found:.6g}") == found


def test_the_text_is_the_same_every_time_and_ends_with_a_newline() -> None:
    text = report_json(report((PASSED, FAILED)))
    assert text == report_json(report((PASSED, FAILED)))
    assert text.endswith("}\n")


@pytest.mark.parametrize(
    ("checks", "ok"),
    [
        ((PASSED,), True),
        ((PASSED, SKIPPED), True),
        ((PASSED, FAILED), False),
        ((FAILED,), False),
        ((SKIPPED,), False),
        ((), False),
    ],
)
def test_ok_needs_a_check_that_ran_and_none_that_failed(checks: tuple[Check, ...], ok: bool) -> None:
    assert report(checks).ok is ok
    assert content(report(checks))["ok"] is ok


def test_a_report_cannot_be_edited() -> None:
    made = report()
    with pytest.raises(TypeError):
        made.parts["blue"] = PART  # type: ignore[index]
    with pytest.raises(AttributeError):
        made.name = "other"  # type: ignore[misc]
