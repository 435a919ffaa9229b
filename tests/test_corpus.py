"""Real meshes: broken ones end in one line, closed ones in a sound pair. Where they are, FABRICATE_CORPUS says."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from fabricate import pipeline
from fabricate.cli import main
from fabricate.config import load_config

CORPUS = Path(os.environ.get("FABRICATE_CORPUS", "none"))
BAD = sorted(path for path in (CORPUS / "bad").glob("*") if path.is_file())
GOOD = ("dodecahedron_pentagons.obj", "toroidal_tet_quads_g3.obj", "quadknot_g1.obj")

pytestmark = pytest.mark.skipif(not BAD, reason="FABRICATE_CORPUS names no folder with meshes in bad/ and good/")


def config_for(mesh: Path, folder: Path, *, tile_size: float, tolerance: float) -> Path:
    path = folder / "mesh.toml"
    path.write_text(
        f'[source]\npath = "{mesh.resolve()}"\nsize = "100 mm"\n'
        f'[pattern]\ntile_size = "{tile_size} mm"\n'
        f'[solid]\nthickness = "2 mm"\nclearance = "0.3 mm"\ntolerance = "{tolerance} mm"\n'
    )
    return path


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


@pytest.mark.slow
@pytest.mark.parametrize("name", GOOD)
def test_a_closed_mesh_makes_a_sound_pair(name: str, tmp_path: Path) -> None:
    """Walls and necks may be too small for a process: these meshes have details of all sizes."""
    path = config_for(CORPUS / "good" / name, tmp_path, tile_size=7, tolerance=0.2)
    report = pipeline.run(load_config(path), name="mesh", out=tmp_path / "out", progress=lambda _: None)
    of_the_process = (".wall", "pattern.neck", "fit.process_gap")
    assert [check.message for check in report.checks if check.failed and not check.code.endswith(of_the_process)] == []
    assert report.mesh is not None
    assert report.pattern is not None
    assert (report.pattern.curves, report.pattern.regions) == (1, 2)
    assert report.pattern.handles.yellow + report.pattern.handles.blue == report.mesh.genus
