"""Fit coupons end to end: all files or none, their necks and gaps as the sculpture has them, and what is refused."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from small_ring import ring_config

from fabricate import pipeline
from fabricate.checks.coupon_report import CouponReport
from fabricate.config import load_config
from fabricate.errors import FabricateError, SolidError
from fabricate.fit_coupon import make_coupon

CONFIG = ring_config(tolerance="0.3 mm")


def made(folder: Path, *overrides: str, name: str = "ring-coupon", text: str = CONFIG) -> tuple[CouponReport, ...]:
    path = folder / "ring.toml"
    path.write_text(text)
    return make_coupon(load_config(path, overrides), name=name, out=folder / "out", progress=lambda _: None)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("coupon")
    (report,) = made(folder)
    assert report.ok
    return folder / "out" / "ring-coupon"


def recorded(folder: Path) -> dict[str, Any]:
    return dict(json.loads((folder / "report.json").read_text()))


def test_the_folder_is_complete_and_alone(folder: Path) -> None:
    assert [path.name for path in folder.parent.iterdir()] == ["ring-coupon"]
    names = {path.name for path in folder.iterdir()}
    assert names == {"coupon.stl", "coupon.3mf", "preview.png", "report.json", "config.toml"}
    assert load_config(folder / "config.toml") == load_config(folder.parents[1] / "ring.toml")


def test_the_gaps_in_the_report_are_those_on_the_labels(folder: Path) -> None:
    pieces = recorded(folder)["pieces"]
    assert [piece["label"] for piece in pieces[::2]] == ["0.20", "0.25", "0.30", "0.35", "0.40"]
    for piece in pieces:
        assert float(piece["label"]) == piece["clearance_mm"]
        assert piece["gap_mm"]["min"] >= 0.95 * piece["clearance_mm"]


def test_the_neck_is_that_of_the_sculpture(folder: Path) -> None:
    config = load_config(folder / "config.toml")
    (sculpture,) = pipeline.run(config, name="ring", out=folder.parents[1] / "run", progress=lambda _: None)
    neck = recorded(folder)["places"]["neck"]
    assert sculpture.pattern is not None
    assert neck["size_mm"] == pytest.approx(sculpture.pattern.neck_mm.min, rel=1e-5)
    assert recorded(folder)["config_sha256"] == sculpture.config_sha256
    (own,) = (
        piece["neck_mm"]["min"]
        for piece in recorded(folder)["pieces"]
        if (piece["kind"], piece["label"]) == ("neck", "0.30")
    )
    finished = sculpture.parts[neck["region"]].neck_mm
    assert finished is not None
    assert own >= finished.min - 0.02


def test_it_is_made_again_byte_by_byte_and_replaces_the_old_one(folder: Path, tmp_path: Path) -> None:
    for _ in range(2):
        made(tmp_path)
    for name in ("coupon.stl", "coupon.3mf", "preview.png"):
        assert (tmp_path / "out" / "ring-coupon" / name).read_bytes() == (folder / name).read_bytes()


def test_with_clearance_0_it_is_refused_before_anything_is_read(tmp_path: Path) -> None:
    text = '[source]\npath = "none.obj"\n'
    with pytest.raises(SolidError, match=r"solid\.clearance is 0 mm"):
        made(tmp_path, "solid.clearance=0mm", text=text)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("setting", ["solid.clearance=2.2mm", "solid.thickness=0.6mm"])
def test_what_cannot_be_made_is_one_line_and_nothing_is_written(tmp_path: Path, setting: str) -> None:
    with pytest.raises(FabricateError) as caught:
        made(tmp_path, setting)
    assert "\n" not in str(caught.value)
    assert not (tmp_path / "out").exists()
