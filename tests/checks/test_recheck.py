"""Judging what lies on disk: a finished folder, bare files, and folders that are not what they should be."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
import trimesh

from fabricate import pipeline
from fabricate.checks.check import Check
from fabricate.checks.judge import read_part
from fabricate.checks.recheck import Recheck, rechecked
from fabricate.config import load_config
from fabricate.errors import ReadError
from fabricate.output.curve_ply import write_curves
from fabricate.output.stl import write_stl
from fabricate.solid.part import Part

CONFIG = """
[source]
shape = "sphere"
frequency = 1
size = "50 mm"

[pattern]
tile_size = "14 mm"

[solid]
thickness = "2 mm"
tolerance = "0.3 mm"
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("recheck")
    path = folder / "small.toml"
    path.write_text(CONFIG)
    pipeline.run(load_config(path), name="small", out=folder / "out", progress=lambda _: None)
    return folder / "out" / "small"


@pytest.fixture(scope="module")
def banded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three parts, on larger tiles."""
    folder = tmp_path_factory.mktemp("banded")
    path = folder / "banded.toml"
    path.write_text(CONFIG)
    settings = ["pattern.rings=[0.36, 0.64]", "pattern.tile_size=20mm"]
    pipeline.run(load_config(path, settings), name="banded", out=folder / "out", progress=lambda _: None)
    return folder / "out" / "banded"


@pytest.fixture
def copy(made: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(made, tmp_path / "small"))


def failed(found: Recheck) -> set[str]:
    return {check.code for check in found.judgement.checks if check.failed}


def named(found: Recheck, code: str) -> Check:
    return next(check for check in found.judgement.checks if check.code == code)


def ball(name: str, *, x: float) -> Part:
    mesh = trimesh.creation.icosphere(subdivisions=2, radius=5.0)
    return Part(name, mesh.vertices + np.array([x, 0, 0]), mesh.faces)


def test_a_folder_without_its_config_says_what_is_missing(made: Path, tmp_path: Path) -> None:
    copy = tmp_path / "copy"
    shutil.copytree(made, copy)
    (copy / "config.toml").unlink()
    with pytest.raises(ReadError, match="put it back"):
        rechecked([copy], clearance=None)


def test_a_finished_folder_passes_with_all_that_its_report_knows(made: Path) -> None:
    found = rechecked([made], clearance=None)
    recorded = json.loads((made / "report.json").read_text())
    assert failed(found) == set()
    assert (found.name, found.config_sha256) == ("small", recorded["config_sha256"])
    assert {name: part.volume_mm3 for name, part in found.judgement.parts.items()} == pytest.approx(
        {name: part["volume_mm3"] for name, part in recorded["parts"].items()}, rel=1e-5
    )
    for code in ("yellow.genus", "fit.gap", "yellow.recorded_volume", "blue.recorded_volume"):
        assert named(found, code).ok


@pytest.mark.parametrize("name", ["made", "banded"])
def test_the_verdict_is_that_of_the_run(name: str, request: pytest.FixtureRequest) -> None:
    folder = request.getfixturevalue(name)
    recorded = json.loads((folder / "report.json").read_text())
    found = rechecked([folder], clearance=None).judgement.checks
    assert {check["code"]: (check["ok"], check["skipped"]) for check in recorded["checks"]} == {
        check.code: (check.ok, check.skipped) for check in found if not check.code.endswith(".recorded_volume")
    }
    said = {check["code"]: check["message"] for check in recorded["checks"]}
    wide = [check for check in found if check.code.endswith(".gap_max")]
    assert len(wide) == len(recorded["parts"]) - 1
    assert [check.message for check in wide] == [said[check.code] for check in wide]


def test_what_the_report_records_is_said_to_be_so(banded: Path) -> None:
    found = rechecked([banded], clearance=None)
    for code in ("pattern.neck", "pattern.band", "fit.whole"):
        assert named(found, code).message.endswith("as recorded in report.json)"), code
    assert "recorded" not in named(found, "fit.joined").message


def test_a_gap_too_wide_for_the_clearance_that_is_asked_for_is_noticed(made: Path) -> None:
    assert failed(rechecked([made], clearance=0.2)) == {"fit.gap_max"}


def test_a_part_that_shrank_is_noticed(copy: Path) -> None:
    part = read_part(copy / "yellow.stl")
    write_stl(copy / "yellow.stl", Part("yellow", 0.98 * part.points, part.triangles))
    assert {"yellow.recorded_volume", "fit.whole"} <= failed(rechecked([copy], clearance=None))


def test_without_a_mid_line_the_widest_gap_is_skipped(copy: Path) -> None:
    write_curves(copy / "curve.ply", [np.eye(3)])
    found = rechecked([copy], clearance=None)
    assert named(found, "fit.gap_max").skipped
    (copy / "curve.ply").write_bytes(b"ply\n")
    with pytest.raises(ReadError, match=r"curve\.ply"):
        rechecked([copy], clearance=None)
    (copy / "curve.ply").unlink()
    with pytest.raises(ReadError, match=r"curve\.ply: not found"):
        rechecked([copy], clearance=None)


def test_parts_that_changed_places_are_noticed(copy: Path) -> None:
    (copy / "yellow.stl").rename(copy / "swap.stl")
    (copy / "blue.stl").rename(copy / "yellow.stl")
    (copy / "swap.stl").rename(copy / "blue.stl")
    assert failed(rechecked([copy], clearance=None)) == {"yellow.recorded_volume", "blue.recorded_volume"}


def test_a_part_of_the_wrong_genus_is_noticed(copy: Path) -> None:
    ring = trimesh.creation.torus(500.0, 1.0)
    write_stl(copy / "yellow.stl", Part("yellow", ring.vertices, ring.faces))
    assert {"yellow.genus", "yellow.recorded_volume"} <= failed(rechecked([copy], clearance=None))


def test_a_clearance_that_is_asked_for_replaces_that_of_the_config(made: Path) -> None:
    assert "fit.gap" in failed(rechecked([made], clearance=1.0))


@pytest.mark.parametrize(("share", "moved"), [(0.99995, False), (0.9998, True), (1.0002, True)])
def test_a_volume_has_moved_from_a_ten_thousandth_on(copy: Path, share: float, moved: bool) -> None:
    report = json.loads((copy / "report.json").read_text())
    report["parts"]["blue"]["volume_mm3"] *= share
    (copy / "report.json").write_text(json.dumps(report))
    assert ("blue.recorded_volume" in failed(rechecked([copy], clearance=None))) == moved


def test_bare_files_are_judged_by_what_they_tell(tmp_path: Path) -> None:
    paths = [tmp_path / "left.stl", tmp_path / "right.stl"]
    for path, x in zip(paths, (-5.2, 5.2), strict=True):
        write_stl(path, ball(path.stem, x=x))
    found = rechecked(paths, clearance=0.3)
    assert (found.name, found.config_sha256) == ("left+right", "")
    assert set(found.judgement.parts) == {"left", "right"}
    assert named(found, "fit.gap").ok
    assert named(found, "left.genus").skipped
    assert "fit.gap" in failed(rechecked(paths, clearance=0.6))


def test_a_single_file_is_judged_by_itself(tmp_path: Path) -> None:
    write_stl(tmp_path / "ball.stl", ball("ball", x=0.0))
    found = rechecked([tmp_path / "ball.stl"], clearance=None)
    assert found.judgement.fit is None
    assert failed(found) == set()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (None, "not found"),
        ("not json", "not a report"),
        ("[]", "not a report"),
        ('{"name": "small"}', "not a report"),
        ("\udcff", "not a report"),
    ],
)
def test_a_folder_without_a_report_is_one_readable_line(copy: Path, text: str | None, words: str) -> None:
    report = copy / "report.json"
    report.unlink()
    if text is not None:
        report.write_bytes(text.encode(errors="surrogateescape"))
    with pytest.raises(ReadError, match=words) as caught:
        rechecked([copy], clearance=None)
    assert str(report) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_missing_part_is_a_read_error(copy: Path) -> None:
    (copy / "blue.stl").unlink()
    with pytest.raises(ReadError, match=r"blue\.stl"):
        rechecked([copy], clearance=None)


def test_folders_and_files_are_not_mixed(made: Path) -> None:
    with pytest.raises(ReadError, match="one folder or several STL files were expected, found 2"):
        rechecked([made, made / "blue.stl"], clearance=None)
