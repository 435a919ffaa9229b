"""What slicers and repair programs say of the finished files: nothing to repair."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from small_ring import ring_config

from fabricate import pipeline
from fabricate.config import load_config
from fabricate.fit_coupon import make_coupon

pytestmark = pytest.mark.slicer

CONFIG = ring_config(tolerance="0.3 mm")
REPAIRS = ("open_edges", "facets_reversed", "facets_removed", "facets_added", "edges_fixed", "backwards_edges")
PARTS = ("yellow", "blue")


def program(name: str) -> str:
    """Return where a program is, or skip the test and say so where nobody overlooks it."""
    found = shutil.which(name)
    if found is None:
        reason = f"{name} is missing, so no file was judged by it: apt-get install {name}"
        warnings.warn(reason, stacklevel=2)
        pytest.skip(reason)
    return found


def said_by(*command: str) -> str:
    return subprocess.run(command, capture_output=True, text=True, check=True, timeout=120).stdout


def slicer_facts(path: Path) -> dict[str, str]:
    """Return what `prusa-slicer --info` says of a file, by key."""
    text = said_by(program("prusa-slicer"), "--info", str(path))
    return dict(re.findall(r"^(\w+) = *(\S+)$", text, re.MULTILINE))


def slicer_faults(path: Path, *, volume: float) -> list[str]:
    """Return what the slicer finds wrong with a file."""
    facts = slicer_facts(path)
    faults = [f"{key} = {facts[key]}" for key in REPAIRS if key in facts]
    for key, wanted in (("manifold", "yes"), ("number_of_parts", "1")):
        if facts.get(key) != wanted:
            faults.append(f"{key} = {facts.get(key)}")
    if abs(float(facts["volume"]) - volume) > 1e-3 * abs(volume):
        faults.append(f"volume = {facts['volume']}")
    return faults


def admesh_faults(path: Path) -> list[str]:
    """Return the lines in which admesh counts a defect of the file as it was, or a repair."""
    text = said_by(program("admesh"), str(path))
    counts = re.findall(
        r"^((?:Facets with|Total|Degenerate|Edges|Facets|Backwards|Normals)[^:\n]*?) *: +(\d+)", text, re.MULTILINE
    )
    assert len(counts) >= 9, text
    return [f"{what}: {count}" for what, count in counts if int(count)]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("slicer")
    path = folder / "small.toml"
    path.write_text(CONFIG)
    pipeline.run(load_config(path), name="small", out=folder / "out", progress=lambda _: None)
    return folder / "out" / "small"


def recorded(made: Path, name: str) -> dict[str, Any]:
    return dict(json.loads((made / "report.json").read_text())["parts"][name])


def holed(path: Path, place: Path) -> Path:
    """Write a copy of a binary STL without its first triangle."""
    data = path.read_bytes()
    count = int.from_bytes(data[80:84], "little") - 1
    place.write_bytes(data[:80] + np.uint32(count).tobytes() + data[134:])
    return place


def turned(path: Path, place: Path) -> Path:
    """Write a copy of a binary STL whose first triangle faces the other way."""
    data = bytearray(path.read_bytes())
    data[96:108], data[108:120] = data[108:120], data[96:108]
    place.write_bytes(data)
    return place


@pytest.mark.parametrize("name", PARTS)
def test_prusa_slicer_has_nothing_to_repair(made: Path, name: str) -> None:
    assert slicer_faults(made / f"{name}.stl", volume=recorded(made, name)["volume_mm3"]) == []


@pytest.mark.parametrize("name", PARTS)
def test_admesh_has_nothing_to_repair(made: Path, name: str) -> None:
    assert admesh_faults(made / f"{name}.stl") == []


def test_the_slicer_counts_every_triangle(made: Path) -> None:
    facts = slicer_facts(made / "yellow.stl")
    assert int(facts["number_of_facets"]) == recorded(made, "yellow")["triangles"]


def test_a_hole_is_noticed(made: Path, tmp_path: Path) -> None:
    broken = holed(made / "yellow.stl", tmp_path / "holed.stl")
    assert slicer_faults(broken, volume=recorded(made, "yellow")["volume_mm3"])
    assert admesh_faults(broken)


def test_a_turned_triangle_is_noticed(made: Path, tmp_path: Path) -> None:
    assert admesh_faults(turned(made / "yellow.stl", tmp_path / "turned.stl"))


def test_another_volume_is_noticed(made: Path) -> None:
    volume = recorded(made, "yellow")["volume_mm3"]
    assert slicer_faults(made / "yellow.stl", volume=1.002 * volume) != []


def layers(gcode: str) -> list[int]:
    """Return how many moves extrude in each layer."""
    return [
        len(re.findall(r"^G1 X\S+ Y\S+ E\d*\.?\d+", layer, re.MULTILINE)) for layer in gcode.split(";LAYER_CHANGE")[1:]
    ]


@pytest.fixture(scope="module")
def plate(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("coupon")
    path = folder / "small.toml"
    path.write_text(CONFIG)
    make_coupon(load_config(path), name="small-coupon", out=folder, progress=lambda _: None)
    return folder / "small-coupon"


def test_a_coupon_has_nothing_to_repair_and_prints_without_supports(plate: Path, tmp_path: Path) -> None:
    facts = slicer_facts(plate / "coupon.stl")
    assert (facts["manifold"], facts["number_of_parts"], facts["min_z"]) == ("yes", "11", "0.000000")
    assert [key for key in REPAIRS if key in facts] == []
    assert admesh_faults(plate / "coupon.stl") == []
    out = tmp_path / "out.gcode"
    automatic = ("--support-material", "--support-material-threshold", "40")
    said = said_by(program("prusa-slicer"), "--export-gcode", *automatic, "-o", str(out), str(plate / "coupon.stl"))
    assert "mpty layer" not in said
    assert min(layers(out.read_text())) > 0
    assert ";TYPE:Support" not in out.read_text()


@pytest.mark.slow
@pytest.mark.parametrize("file", ["yellow.stl", "blue.stl", "pair.3mf"])
def test_every_layer_of_what_is_sliced_is_printed(made: Path, tmp_path: Path, file: str) -> None:
    two = ("--nozzle-diameter", "0.4,0.4", "--filament-diameter", "1.75,1.75", "--temperature", "200,200")
    coarse = ("--layer-height", "0.3", "--fill-density", "0", "--dont-arrange")
    out = tmp_path / "out.gcode"
    said = said_by(program("prusa-slicer"), "--export-gcode", *coarse, *two, "-o", str(out), str(made / file))
    assert "mpty layer" not in said
    gcode = out.read_text()
    assert len(layers(gcode)) > 50
    assert min(layers(gcode)) > 0
    changes = re.findall(r"^T[01]\b", gcode, re.MULTILINE)
    assert (changes.count("T0") > 10, changes.count("T1") > 10) == (file == "pair.3mf", file == "pair.3mf")
