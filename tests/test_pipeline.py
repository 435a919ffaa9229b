"""The straight line end to end: all files or none, what the report says, and what `check` finds."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mesh_bytes import ply_with_values
from small_ring import ring_config

from fabricate import dividing, pipeline
from fabricate.checks.report import Report
from fabricate.cli import main
from fabricate.config import load_config
from fabricate.design.curve_wish import CurveWish
from fabricate.design.designed import Design, designed
from fabricate.design.field import field_weights
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.errors import OutputError
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.torus import torus
from fabricate.output.stl import TRIANGLE
from fabricate.surface.tile_places import TilePlaces

CONFIG = ring_config(tolerance="0.15 mm")
FILES = {
    *("yellow.stl", "blue.stl", "pair.3mf", "preview.png", "preview.glb"),
    *("curve.ply", "report.json", "config.toml"),
}
CONFIGS = sorted((Path(__file__).parents[1] / "configs").rglob("*.toml"))
ROUGH = ("pattern.tile_size=14mm", "solid.tolerance=0.4mm")
FRAME = ("pattern.tile_size=10mm", "solid.tolerance=0.15mm")
WIDE = {"cells-hexagons", "cells-triangles", "genus-6", "genus-six", "long-tiles", "shared-handles"}
COARSE = {
    **dict.fromkeys(("double-torus", "triple-torus", "genus-6"), FRAME),
    **dict.fromkeys(("genus-two", "genus-three", "genus-six"), FRAME),
    "cells-quads": ("solid.tolerance=0.4mm",),
    **dict.fromkeys(("cells-triangles", "cells-hexagons"), ("solid.tolerance=0.4mm", "prepare.detail=smooth")),
}
"""How coarse configs are run: the thin and narrowly bent bars of frames need smaller triangles, and new cells the tiles
that they are made for."""
JUDGE = os.environ.get("FABRICATE_VERIFY", "")


def silent(_: str) -> None:
    """Hear of a stage and say nothing."""


def run(path: Path, out: Path, *overrides: str) -> Report:
    (report,) = pipeline.run(load_config(path, overrides), name=path.stem, out=out, progress=silent)
    return report


@pytest.fixture(scope="module")
def config(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("config") / "small.toml"
    path.write_text(CONFIG)
    return path


@pytest.fixture(scope="module")
def made(config: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a finished run."""
    out = tmp_path_factory.mktemp("out")
    assert run(config, out).ok
    return out / "small"


@pytest.fixture(scope="module")
def report(made: Path) -> dict[str, Any]:
    return dict(json.loads((made / "report.json").read_text()))


@pytest.fixture
def copy(made: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(made, tmp_path / "small"))


def test_every_file_is_there_and_nothing_else(made: Path) -> None:
    assert {path.name for path in made.iterdir()} == FILES
    assert [path.name for path in made.parent.iterdir()] == ["small"]


def test_the_report_has_the_keys_of_the_contract(report: dict[str, Any]) -> None:
    assert set(report) == {
        *("name", "ok", "config_sha256", "versions", "mesh"),
        *("pattern", "parts", "finish", "joint", "fit", "wire", "checks", "seconds"),
    }
    assert set(report["mesh"]) == {
        *("vertices", "faces", "genus", "size_mm", "repairs", "notes", "distance_mm", "chord_mm"),
    }
    assert set(report["pattern"]) == {
        *("tiles", "tile_size_mm", "tile_quality", "curves", "regions", "curve_length_mm", "arc"),
        *("area_share", "handles", "neck_mm", "band_mm", "alignment", "locked", "objectives", "notes"),
    }
    assert set(report["pattern"]["tile_quality"]) == {
        *("aspect_median", "aspect_p95", "aspect_max", "size_ratio", "warnings"),
    }
    assert set(report["parts"]) == {"yellow", "blue"}
    for part in report["parts"].values():
        assert set(part) == {
            *("file", "triangles", "volume_mm3", "area_mm2", "genus"),
            *("components", "watertight", "self_intersections", "wall_mm", "neck_mm"),
        }
        assert set(part["wall_mm"]) == {"min", "median"}
    assert report["finish"] == {"openings": [], "base": None, "notes": []}
    assert report["joint"]["kind"] == "straight"
    assert report["joint"]["ridge_mm"] is None
    assert set(report["fit"]) == {
        *("clearance_mm", "gap_mm", "overlap_mm3", "verdict", "play_mm", "witness", "pairs", "spaces_mm3"),
    }
    assert set(report["fit"]["gap_mm"]) == {"min", "at", "queried", "max", "max_at"}
    assert set(report["fit"]["play_mm"]) == {"x", "y", "z", "rx", "ry", "rz"}
    assert all(set(check) == {"code", "ok", "skipped", "message", "where"} for check in report["checks"])


def test_the_report_proves_the_pair(report: dict[str, Any]) -> None:
    pattern, handles = report["pattern"], report["pattern"]["handles"]
    assert (report["ok"], report["name"], report["mesh"]["genus"]) == (True, "small", 1)
    assert (pattern["curves"], pattern["regions"]) == (1, 2)
    assert sum(handles.values()) == 1
    assert sum(pattern["area_share"].values()) == pytest.approx(1, abs=1e-5)
    for colour, part in report["parts"].items():
        assert part["genus"] == 2 * handles[colour]
        assert (part["watertight"], part["components"], part["self_intersections"]) == (True, 1, 0)
    assert report["fit"]["verdict"] == "captive"
    assert report["fit"]["gap_mm"]["min"] >= 0.95 * 0.3
    assert report["fit"]["overlap_mm3"] == 0


def test_every_stage_is_timed_and_told(config: Path, tmp_path: Path, report: dict[str, Any]) -> None:
    told: list[str] = []
    pipeline.run(load_config(config), name="small", out=tmp_path, progress=told.append)
    assert told == list(report["seconds"])
    assert told[0] == "read"
    assert all(seconds >= 0 for seconds in report["seconds"].values())


def test_the_hash_is_that_of_the_config_file(made: Path, report: dict[str, Any]) -> None:
    assert report["config_sha256"] == hashlib.sha256((made / "config.toml").read_bytes()).hexdigest()


def test_the_resolved_config_makes_the_same_bytes(made: Path, tmp_path: Path) -> None:
    path = tmp_path / "small.toml"
    shutil.copy(made / "config.toml", path)
    run(path, tmp_path / "again")
    for name in FILES - {"report.json"}:
        assert (tmp_path / "again" / "small" / name).read_bytes() == (made / name).read_bytes(), name


def test_an_area_share_is_met_and_its_arc_reported(config: Path, tmp_path: Path) -> None:
    assert run(config, tmp_path, "pattern.area_share=0.4").ok
    found = json.loads((tmp_path / "small" / "report.json").read_text())
    assert found["pattern"]["area_share"]["yellow"] == pytest.approx(0.4, abs=0.001)
    assert 0.4 < found["pattern"]["arc"] < 0.47
    assert [check["ok"] for check in found["checks"] if check["code"] == "pattern.area_share"] == [True]


@pytest.fixture(scope="module")
def with_curve(config: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a run that was asked for a wire and two drawings."""
    out = tmp_path_factory.mktemp("curve")
    assert run(config, out, "curve.wire=2mm", 'curve.views=["front", "top"]').ok
    return out / "small"


def test_wire_and_drawings_appear_where_asked_for(with_curve: Path) -> None:
    more = {"wire.stl", "curve-front.svg", "curve-top.svg"}
    assert {path.name for path in with_curve.iterdir()} == FILES | more
    wire = json.loads((with_curve / "report.json").read_text())["wire"]
    assert set(wire) == {
        *("file", "triangles", "volume_mm3", "area_mm2", "genus", "components", "watertight"),
        *("self_intersections", "wall_mm", "neck_mm", "diameter_mm", "length_mm"),
    }
    assert (wire["file"], wire["genus"], wire["self_intersections"], wire["diameter_mm"]) == ("wire.stl", 1, 0, 2.0)
    assert wire["volume_mm3"] == pytest.approx(np.pi * wire["length_mm"], rel=0.06)
    if JUDGE:
        command = [sys.executable, JUDGE, str(with_curve / "wire.stl")]
        assert subprocess.run(command, capture_output=True, check=False).returncode == 0


def test_check_judges_the_wire_as_well(with_curve: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    copy = Path(shutil.copytree(with_curve, tmp_path / "small"))
    assert status("check", str(copy)) == 0
    assert "passed  wire.genus" in capsys.readouterr().out
    move_vertex(copy / "wire.stl", by=8.0)
    assert status("check", str(copy)) == 1
    assert "FAILED  wire.recorded_volume" in capsys.readouterr().out


def test_another_seed_makes_another_pair(made: Path, config: Path, tmp_path: Path) -> None:
    run(config, tmp_path, "pattern.seed=8")
    assert (tmp_path / "small" / "yellow.stl").read_bytes() != (made / "yellow.stl").read_bytes()


def status(*arguments: str) -> int:
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    return int(caught.value.code or 0)


def test_handles_move_to_yellow_and_objectives_get_better(config: Path, tmp_path: Path) -> None:
    asked = ("pattern.handles={yellow=1}", "optimise.tips=1", "optimise.flips=400", "optimise.seconds=1000")
    report = run(config, tmp_path, *asked)
    assert report.ok
    pattern = json.loads((tmp_path / "small" / "report.json").read_text())["pattern"]
    assert pattern["handles"] == {"yellow": 1, "blue": 0}
    assert {name: part.genus for name, part in report.parts.items()} == {"yellow": 2, "blue": 0}
    assert set(pattern["objectives"]) == {"neck", "evenness", "tips", "corridor"}
    assert pattern["objectives"]["tips"]["after"] < pattern["objectives"]["tips"]["before"]
    assert report.notes == ()
    assert run(config, tmp_path / "short", *asked[:2], "optimise.seconds=1e-9").notes[0].startswith("optimising ended")


def test_check_passes_what_run_made(copy: Path) -> None:
    assert status("check", str(copy)) == 0
    assert status("check", str(copy / "yellow.stl"), str(copy / "blue.stl"), "--clearance", "0.3 mm") == 0


def test_a_multitone_is_made_proved_and_checked(
    config: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sizes = ("source.size=100mm", "pattern.tile_size=20mm", "solid.tolerance=0.2mm")
    report = run(config, tmp_path, 'pattern.rings="four"', *sizes)
    names = ["yellow", "band-1", "band-2", "blue"]
    folder = tmp_path / "small"
    assert {path.name for path in folder.glob("*.stl")} == {f"{name}.stl" for name in names}
    assert list(report.parts) == names
    assert report.pattern is not None
    assert report.fit is not None
    assert (report.pattern.curves, report.pattern.regions) == (3, 4)
    assert list(report.pattern.handles.items()) == [("yellow", 0), ("band-1", 0), ("band-2", 0), ("blue", 1)]
    assert sum(report.pattern.area_share.values()) == pytest.approx(1)
    assert [part.genus for part in report.parts.values()] == [0, 1, 1, 2]
    neighbours = {name for name, pair in report.fit.pairs.items() if pair.verdict == "captive"}
    assert neighbours == {"yellow-band-1", "band-1-band-2", "band-2-blue"}
    assert (report.fit.verdict, failed(report, with_printability=False)) == ("captive", [])
    assert status("check", str(folder)) in (0, 1)
    said = capsys.readouterr().out
    assert all(f"passed  {name}.genus" in said for name in names)
    assert "passed  fit.band-1-band-2.gap" in said
    if JUDGE:
        parts = [str(folder / f"{name}.stl") for name in names]
        judged = subprocess.run(
            [sys.executable, JUDGE, *parts, "--clearance", "0.3"], capture_output=True, text=True, check=False
        )
        assert judged.returncode == 0, judged.stdout + judged.stderr


def test_one_ring_is_an_arc(config: Path, made: Path, tmp_path: Path) -> None:
    run(config, tmp_path, "pattern.rings=[0.5]")
    for name in FILES - {"report.json", "config.toml"}:
        assert (tmp_path / "small" / name).read_bytes() == (made / name).read_bytes(), name


def test_openings_and_a_stand_are_made_and_expected_again(config: Path, tmp_path: Path) -> None:
    openings, base = 'solid.openings={diameter="2 mm",count=2}', 'solid.base={height="3 mm"}'
    made = run(config, tmp_path, openings, base, "solid.thickness={min='1.8 mm',max='2.6 mm',by='height'}")
    assert [check.code for check in made.checks if check.failed] == []
    assert made.finish is not None
    assert made.finish.base is not None
    assert len(made.finish.openings) == 2
    assert status("check", str(tmp_path / "small")) == 0


def move_vertex(path: Path, *, by: float) -> None:
    """Move one vertex of a binary STL away from the origin, in all of its triangles, and nothing else."""
    data = bytearray(path.read_bytes())
    corners = np.frombuffer(data, TRIANGLE, offset=84)["corners"]
    chosen = (corners == corners[0, 0]).all(axis=2)
    corners[chosen] += np.float32(by) * corners[0, 0] / np.linalg.norm(corners[0, 0])
    path.write_bytes(data)


def test_check_notices_a_moved_vertex(copy: Path, capsys: pytest.CaptureFixture[str]) -> None:
    move_vertex(copy / "yellow.stl", by=8.0)
    assert status("check", str(copy)) == 1
    said = capsys.readouterr().out
    assert "FAILED  yellow.recorded_volume" in said
    assert "FAILED  blue.recorded_volume" not in said


@pytest.mark.parametrize("name", ["write_parts", "write_pictures", "report_json"])
def test_nothing_remains_of_a_run_that_fails(
    config: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise OutputError("disk full")

    monkeypatch.setattr(pipeline, name, fail)
    with pytest.raises(OutputError, match="disk full"):
        run(config, tmp_path / "out")
    assert not list(tmp_path.iterdir())


def test_results_from_before_survive_a_run_that_fails(
    config: Path, copy: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = {path.name: path.read_bytes() for path in copy.iterdir()}

    def fail(*_: object, **__: object) -> None:
        raise OutputError("disk full")

    monkeypatch.setattr(pipeline, "report_json", fail)
    with pytest.raises(OutputError):
        run(config, copy.parent)
    assert {path.name: path.read_bytes() for path in copy.iterdir()} == before
    assert [path.name for path in copy.parent.iterdir()] == ["small"]


def obj(mesh: PolygonMesh, *, drop: int = 0, shift: float | None = None) -> str:
    """Return a mesh as OBJ text, without its last faces, or with a shifted copy of itself beside it."""
    faces = np.split(mesh.corners, mesh.offsets[1:-1])[: len(mesh.offsets) - 1 - drop]
    points = mesh.points
    if shift is not None:
        faces += [face + len(points) for face in faces]
        points = np.concatenate([points, points + shift])
    lines = [f"v {x} {y} {z}" for x, y, z in points]
    return "\n".join(lines + ["f " + " ".join(str(number + 1) for number in face) for face in faces])


EVEN, ODD = torus(around=8, across=4, tube=0.45), torus(around=7, across=5, tube=0.45)
MESHES = {
    "good.obj": obj(EVEN),
    "open.obj": obj(EVEN, drop=1),
    "several.obj": obj(EVEN, shift=5.0),
    "nan.obj": obj(EVEN).replace("v ", "v nan ", 1),
    "odd.obj": obj(ODD),
    "text.obj": "this is not a mesh",
    "good.ply": ply_with_values("heat", [1, 2, 3, 4]).decode(),
}
HEAT = ["pattern.tree=field", "field.kind=attribute"]
PICTURE = ["pattern.tree=field", "field.kind=image"]
WRONG = {
    "missing file": ('path = "none.obj"', [], "none.obj"),
    "not a mesh": ('path = "text.obj"', [], "text.obj"),
    "open boundary": ('path = "open.obj"', [], "open"),
    "several components": ('path = "several.obj"', [], "2"),
    "nan": ('path = "nan.obj"', [], "nan"),
    "odd cycle": ('path = "odd.obj"', ["pattern.levels=0"], "cycle"),
    "wide clearance": ('shape = "torus"', ["pattern.tile_size=20mm", "solid.clearance=15mm"], "clearance"),
    "no yellow necks": ('shape = "torus"', ["pattern.arc=0.295", "solid.clearance=0.6mm"], "necks"),
    "no blue necks": ('shape = "torus"', ["pattern.arc=0.705", "solid.clearance=0.6mm"], "necks"),
    "rings in reverse": ('shape = "torus"', ["pattern.rings=[0.6, 0.4]"], "increase"),
    "rings out of bounds": ('shape = "torus"', ["pattern.rings=[0.2, 0.4]"], "between 0.293 and 0.707"),
    "no rings": ('shape = "torus"', ["pattern.rings=[]"], "found none"),
    "unknown rings": ('shape = "torus"', ["pattern.rings=thre"], "three"),
    "rings too close": ('shape = "torus"', ["pattern.rings=[0.49, 0.51]"], "band-1"),
    "too many levels": ('shape = "torus"', ["pattern.levels=12"], "levels"),
    "no key": ('shape = "torus"', ["=2"], "key=value"),
    "large tiles": ('shape = "torus"', ["pattern.tile_size=500mm"], "tile"),
    "all yellow": ('shape = "torus"', ["pattern.area_share=0.97", "pattern.tile_size=20mm"], "yellow can have 0.2"),
    "thick wire": ('shape = "torus"', ["curve.wire=30mm", "pattern.tile_size=20mm"], "at most"),
    "unknown view": ('shape = "torus"', ['curve.views=["above"]'], "front"),
    "no thickness": ('shape = "torus"', ["solid.thickness=0mm"], "thickness"),
    "unknown key": ('shape = "torus"\nsizes = "60 mm"', [], "size"),
    "too many handles": ('shape = "double-torus"', ["pattern.handles={yellow=3}"], "genus 2"),
    "no such handles": ('shape = "double-torus"', ["pattern.handles=odd"], "even"),
    "directions missing": ('shape = "torus"', ["optimise.alignment=1"], "direction"),
    "unknown objective": ('shape = "torus"', ["optimise.tip=1"], "optimise.tips"),
    "unknown shape": ('shape = "tors"', [], "torus"),
    "unknown field": ('shape = "torus"', ["pattern.tree=field", "field.kind=hight"], "height"),
    "no field": ('shape = "torus"', ["pattern.tree=field"], "[field]"),
    "no tree": ('shape = "torus"', ["field.kind=height"], "nothing follows"),
    "missing picture": ('shape = "torus"', [*PICTURE, "field.image=none.png"], "no such file"),
    "no picture": ('shape = "torus"', [*PICTURE, "field.image=text.obj"], "another kind of file"),
    "missing attribute": ('path = "good.ply"', [*HEAT, "field.attribute=cold"], "found heat"),
    "attribute of no PLY": ('path = "good.obj"', [*HEAT, "field.attribute=heat"], "only PLY files"),
    "two colours at once": (
        'shape = "torus"',
        ['pattern.locks=[{joined = "yellow", tiles = [3]}, {joined = "blue", tiles = [3]}]'],
        "pattern.locks[0] and pattern.locks[1] contradict each other: tile 3",
    ),
    "ring of locks": (
        'shape = "torus"',
        ['pattern.locks=[{joined = "yellow", side = {point = ["0 mm", "0 mm", "0 mm"], normal = [0, 0, 1]}}]'],
        "close a ring in yellow",
    ),
}


@pytest.mark.parametrize("kind", WRONG)
def test_wrong_input_is_one_line_and_status_2(tmp_path: Path, capsys: pytest.CaptureFixture[str], kind: str) -> None:
    source, overrides, word = WRONG[kind]
    for name, text in MESHES.items():
        (tmp_path / name).write_text(text)
    path = tmp_path / "wrong.toml"
    path.write_text(f'[source]\n{source}\n[solid]\ntolerance = "0.4 mm"\n')
    sets = [part for override in overrides for part in ("--set", override)]
    assert status("run", str(path), "--out", str(tmp_path / "out"), *sets) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.count("\n") == 1
    assert word in said.err
    assert "Traceback" not in said.err
    assert "internal error" not in said.err
    assert not (tmp_path / "out").exists()


def test_a_mesh_from_a_file_makes_a_pair(tmp_path: Path) -> None:
    (tmp_path / "good.obj").write_text(MESHES["good.obj"])
    path = tmp_path / "file.toml"
    path.write_text(CONFIG.replace('shape = "torus"', 'path = "good.obj"').replace("around = 8\nacross = 4\n", ""))
    report = run(path, tmp_path / "out")
    assert report.mesh is not None
    assert (report.mesh.vertices, report.mesh.faces) == (32, 32)
    assert not failed(report, with_printability=False)
    again = run(tmp_path / "out" / "file" / "config.toml", tmp_path / "again")
    assert again.parts == report.parts


def test_a_field_of_the_file_and_locks_make_a_pair(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The ring lies far from the origin, in metres, and its values are its own heights."""
    points = EVEN.points * 0.05 + np.array([3.0, -2.0, 7.0])
    rows = [f"{x} {y} {z} {z}" for x, y, z in points]
    faces = [f"4 {' '.join(map(str, face))}" for face in EVEN.corners.reshape(-1, 4)]
    header = ply_with_values("height", [0] * 4).decode().split("end_header")[0].replace("vertex 4", "vertex 32")
    (tmp_path / "far.ply").write_text("\n".join([header.replace("face 4", "face 32") + "end_header", *rows, *faces]))
    source = CONFIG.replace('shape = "torus"', 'path = "far.ply"').replace("around = 8\nacross = 4\n", "")
    locks = '[[pattern.locks]]\njoined = "blue"\nhold = "most"\ntiles = [0, 1, 2, 3]\n'
    field = '[field]\nkind = "attribute"\nattribute = "height"\n'
    path = tmp_path / "file.toml"
    path.write_text(source.replace("seed = 7", f'seed = 7\ntree = "field"\n{locks}') + field)
    asked: list[tuple[QuadMesh, CurveWish]] = []

    def listening(quads: QuadMesh, wish: CurveWish, *, progress: Callable[[str], None]) -> Design:
        asked.append((quads, wish))
        return designed(quads, wish, progress=progress)

    monkeypatch.setattr(dividing, "designed", listening)
    report = run(path, tmp_path / "out")
    assert not failed(report, with_printability=False)
    assert report.pattern is not None
    assert report.pattern.locked is not None
    assert report.pattern.locked["blue"] > 0
    ((quads, wish),) = asked
    assert wish.field is not None
    heights = TilePlaces.of(quads).middle[:, 2]
    assert np.corrcoef(field_weights(quads, wish.field, seed=0), heights)[0, 1] > 0.97


def failed(report: Report, *, with_printability: bool, wide: bool = False) -> list[str]:
    """Return the sentences of failed checks; walls and necks are for the intended tile size only.

    Where tiles are uneven or bend sharply, the gap is `wide` in places unless the triangles are small.
    """
    of_the_process = (".wall", ".neck", "pattern.band", "fit.process_gap", *([".gap_max"] if wide else []))
    return [
        check.message
        for check in report.checks
        if check.failed and (with_printability or not check.code.endswith(of_the_process))
    ]


@pytest.mark.slow
@pytest.mark.parametrize("path", CONFIGS, ids=lambda path: path.stem)
def test_every_config_makes_a_sound_pair(path: Path, tmp_path: Path) -> None:
    """At low resolution: topology and fit have to hold, walls and necks need not be printable."""
    report = run(path, tmp_path, *COARSE.get(path.stem, ROUGH))
    assert not failed(report, with_printability=False, wide=path.stem in WIDE)
    assert report.pattern is not None
    config = load_config(path)
    curves = len(config.pattern.positions)
    assert (report.pattern.curves, report.pattern.regions) == (curves, curves + 1)
    if config.prepare.cells in ("quads", "triangles", "hexagons"):
        assert report.pattern.tile_size_mm == pytest.approx(config.pattern.tile_size, rel=0.15)
    if JUDGE:
        folder, clearance = tmp_path / path.stem, config.solid.clearance
        parts = [str(folder / f"{name}.stl") for name in report.parts]
        sizes = ["--clearance", str(clearance)] if clearance else []
        judged = subprocess.run([sys.executable, JUDGE, *parts, *sizes], capture_output=True, text=True, check=False)
        assert judged.returncode == 0, judged.stdout + judged.stderr


@pytest.mark.slow
def test_one_job_and_two_make_the_same_bytes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    paths = [tmp_path / f"{name}.toml" for name in ("first", "second")]
    for seed, path in enumerate(paths):
        path.write_text(CONFIG.replace("seed = 7", f"seed = {seed}"))
    for jobs in ("1", "2"):
        assert status("run", *map(str, paths), "--out", str(tmp_path / jobs), "--jobs", jobs) == 0
    assert capsys.readouterr().err == ""
    for name in FILES - {"report.json"}:
        for stem in ("first", "second"):
            one, two = (tmp_path / jobs / stem / name for jobs in ("1", "2"))
            assert one.read_bytes() == two.read_bytes(), name
