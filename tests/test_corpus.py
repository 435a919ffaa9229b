"""Real meshes: broken ones end in one line, closed ones in a sound pair. Where they are, FABRICATE_CORPUS says."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import fabricate as fab
from fabricate import pipeline
from fabricate.checks.report import Report
from fabricate.cli import main
from fabricate.config import load_config
from fabricate.triangles.search_tree import SearchTree

CORPUS = Path(os.environ.get("FABRICATE_CORPUS", "none"))
BAD = sorted(path for path in (CORPUS / "bad").glob("*") if path.is_file())
GOOD = {
    "dodecahedron_pentagons.obj": 0.1,
    "toroidal_tet_quads_g3.obj": 0.2,
    "quadknot_g1.obj": 0.2,
    "spot_control_mesh.obj": 0.2,
    "blub_fish_control_mesh.obj": 0.2,
    "bamboo_pen_quads_g8.obj": 0.6,
}
"""Closed meshes, and a chord tolerance, mm, that keeps the tests short."""

WRAPPED = ("selfx_2torus_test1.obj", "tiny_coords_regr.obj", "open_moebius_quads.obj")
"""Meshes that only a new skin makes into bodies, and soon."""

VERIFY = os.environ.get("FABRICATE_VERIFY")

pytestmark = pytest.mark.skipif(not BAD, reason="FABRICATE_CORPUS names no folder with meshes in bad/ and good/")


def config_for(mesh: Path, folder: Path, *, tile_size: float, tolerance: float, repair: str = "gentle") -> Path:
    path = folder / "mesh.toml"
    path.write_text(
        f'[source]\npath = "{mesh.resolve()}"\nsize = "100 mm"\n'
        f'[prepare]\nrepair = "{repair}"\ncomponents = "largest"\n'
        f'[pattern]\ntile_size = "{tile_size} mm"\n'
        f'[solid]\nthickness = "2 mm"\nclearance = "0.3 mm"\ntolerance = "{tolerance} mm"\n'
    )
    return path


def assert_sound(report: Report, folder: Path) -> None:
    """Walls and necks may be too small for a process: these meshes have details of all sizes.

    Where fins are thinner than two walls, volumes add up less exactly than elsewhere, and gaps are wider.
    """
    of_the_process = (".wall", ".neck", "fit.process_gap", "fit.whole", "fit.gap_max")
    assert [check.message for check in report.checks if check.failed and not check.code.endswith(of_the_process)] == []
    assert_holds(folder)


def assert_holds(folder: Path) -> None:
    """Let the judge that shares no code with us look at the files of a pair, if it is there."""
    if VERIFY:
        judge = [VERIFY, *(str(folder / f"{part}.stl") for part in ("yellow", "blue"))]
        verdict = subprocess.run(
            [sys.executable, *judge, "--clearance", "0.3"], capture_output=True, text=True, check=False
        )
        assert verdict.stdout.rstrip().endswith("holds"), verdict.stdout


@pytest.mark.slow
@pytest.mark.timeout(120)
@pytest.mark.parametrize("mesh", BAD, ids=lambda path: path.name)
def test_a_broken_mesh_ends_in_one_line(mesh: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = config_for(mesh, tmp_path, tile_size=30, tolerance=1.0)
    with pytest.raises(SystemExit) as caught:
        main(["run", str(path), "--out", str(tmp_path / "out")])
    said = capsys.readouterr()
    assert caught.value.code in (0, 1, 2)
    assert "Traceback" not in said.out + said.err
    assert "internal error" not in said.err
    assert (said.out + said.err).count("\n") == 1
    assert (tmp_path / "out").exists() == (caught.value.code != 2)
    if caught.value.code != 2:
        assert_holds(tmp_path / "out" / "mesh")


@pytest.mark.slow
@pytest.mark.timeout(400)
@pytest.mark.parametrize("name", WRAPPED)
def test_what_is_wrapped_makes_a_sound_pair(name: str, tmp_path: Path) -> None:
    pytest.importorskip("pymeshlab")
    path = config_for(CORPUS / "bad" / name, tmp_path, tile_size=7, tolerance=0.05, repair="wrap")
    (report,) = pipeline.run(load_config(path), name="mesh", out=tmp_path / "out", progress=lambda _: None)
    assert_sound(report, tmp_path / "out" / "mesh")
    assert report.mesh is not None
    assert report.mesh.repairs["surfaces wrapped"] == 1


@pytest.mark.slow
@pytest.mark.timeout(400)
@pytest.mark.parametrize("name", GOOD)
def test_a_closed_mesh_makes_a_sound_pair(name: str, tmp_path: Path) -> None:
    path = config_for(CORPUS / "good" / name, tmp_path, tile_size=7, tolerance=GOOD[name])
    (report,) = pipeline.run(load_config(path), name="mesh", out=tmp_path / "out", progress=lambda _: None)
    assert_sound(report, tmp_path / "out" / "mesh")
    assert report.mesh is not None
    assert report.pattern is not None
    assert (report.pattern.curves, report.pattern.regions) == (1, 2)
    assert sum(report.pattern.handles.values()) == report.mesh.genus


@pytest.mark.slow
@pytest.mark.timeout(400)
def test_ears_and_horns_are_thinner_and_hardly_anything_else() -> None:
    """At most 5 % of the inner surface may be nearer than 1.6 mm to the outer one when walls of 2 mm are asked for."""
    mesh = fab.sized(fab.read_closed(CORPUS / "good" / "spot_control_mesh.obj"), size=100)
    duotone = fab.grown_duotone(fab.tiled(mesh, tile_size=7), tree="random", seed=0)
    surface = fab.fitted_cut(duotone, tolerance=0.1, clearance=0.3)
    inner = fab.solids(surface, thickness=2.0, clearance=0.3).spaces[1]
    count = len(surface.points)
    under = inner.points[count : 2 * count]
    distance = SearchTree.of(surface.points, surface.triangles).nearest(under).distance
    assert len(inner.points) == 2 * count
    assert 0.0 < np.mean(distance < 1.6) <= 0.05
    corners = under[surface.triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    thin = (distance[surface.triangles] < 1.6).any(axis=1)
    assert area[thin].sum() <= 0.05 * area.sum()
