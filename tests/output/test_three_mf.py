"""3MF: judged by lib3mf's strict reader, by its plain XML, and by a slicer."""

from __future__ import annotations

import re
import shutil
import subprocess
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import lib3mf
import numpy as np
import pytest
import trimesh

from fabricate.output.three_mf import write_3mf
from fabricate.picture.palette import part_colours
from fabricate.solid.part import Part

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
BALL = trimesh.creation.icosphere(subdivisions=2, radius=8)
RING = trimesh.creation.torus(12, 3)
# Coordinates of very different size, tiny ones too: what a rounded decimal would lose.
ASIDE = np.array([1e-6, 1 / 3, 100.1])
PARTS = (
    Part("yellow", BALL.vertices * 1.0000001 + ASIDE, BALL.faces),
    Part("blue", RING.vertices + ASIDE, RING.faces),
)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    write_3mf(tmp_path / "pair.3mf", PARTS, name="first & last")
    return tmp_path / "pair.3mf"


def model_xml(file: Path) -> ElementTree.Element:
    with zipfile.ZipFile(file) as archive:
        return ElementTree.fromstring(archive.read("3D/3dmodel.model"))  # noqa: S314


def test_the_strict_reader_finds_one_closed_oriented_mesh_with_exact_coordinates(file: Path) -> None:
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(file))
    assert reader.GetWarningCount() == 0
    assert model.GetUnit() == lib3mf.ModelUnit.MilliMeter
    meshes = model.GetMeshObjects()
    assert meshes.MoveNext()
    mesh = meshes.GetCurrentMeshObject()
    assert mesh.GetName() == "first & last"
    assert mesh.IsManifoldAndOriented()
    assert not meshes.MoveNext()
    points = np.array([list(vertex.Coordinates) for vertex in mesh.GetVertices()])
    triangles = np.array([list(triangle.Indices) for triangle in mesh.GetTriangleIndices()])
    for number, part in enumerate(PARTS):
        named = mesh.GetTriangleSet(number)
        assert named.GetName() == part.name
        own = triangles[list(named.GetTriangleList())]
        np.testing.assert_array_equal(points[own], part.points[part.triangles])
        assert set(own.ravel()).isdisjoint(np.delete(triangles, list(named.GetTriangleList()), axis=0).ravel())
    assert mesh.GetTriangleSetCount() == len(PARTS)


def test_the_strict_reader_refuses_a_mesh_with_a_hole(tmp_path: Path) -> None:
    write_3mf(tmp_path / "open.3mf", [Part("open", BALL.vertices, BALL.faces[1:])], name="open")
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.ReadFromFile(str(tmp_path / "open.3mf"))
    meshes = model.GetMeshObjects()
    meshes.MoveNext()
    assert not meshes.GetCurrentMeshObject().IsManifoldAndOriented()


def test_one_object_is_the_only_thing_to_build(file: Path) -> None:
    root = model_xml(file)
    assert root.get("unit") == "millimeter"
    (whole,) = root.findall(f"{CORE}resources/{CORE}object")
    assert whole.get("name") == "first & last"
    (item,) = root.findall(f"{CORE}build/{CORE}item")
    assert item.get("objectid") == whole.get("id")


def test_the_assembly_stands_on_the_build_plate_unturned(file: Path) -> None:
    (item,) = model_xml(file).findall(f"{CORE}build/{CORE}item")
    numbers = np.array(item.get("transform", "").split(), dtype=float).reshape(4, 3)
    np.testing.assert_array_equal(numbers[:3], np.eye(3))
    low = np.concatenate([part.points for part in PARTS]).min(axis=0)
    np.testing.assert_allclose(low + numbers[3], 0, atol=1e-5)


def test_each_part_has_its_colour(file: Path) -> None:
    root = model_xml(file)
    (group,) = root.findall(f"{CORE}resources/{CORE}basematerials")
    bases = group.findall(f"{CORE}base")
    assert [base.get("name") for base in bases] == ["yellow", "blue"]
    colours = part_colours(["yellow", "blue"])
    assert [base.get("displaycolor") for base in bases] == ["#{:02X}{:02X}{:02X}".format(*each) for each in colours]
    (whole,) = root.findall(f"{CORE}resources/{CORE}object")
    own = (whole.get("pid"), whole.get("pindex"))
    found = [
        (triangle.get("pid", own[0]), triangle.get("p1", own[1]))
        for triangle in whole.findall(f"{CORE}mesh/{CORE}triangles/{CORE}triangle")
    ]
    counts = [len(part.triangles) for part in PARTS]
    assert found == [(group.get("id"), str(k)) for k, count in enumerate(counts) for _ in range(count)]


def test_the_slicer_configuration_gives_all_triangles_of_each_part_their_own_extruder(file: Path) -> None:
    with zipfile.ZipFile(file) as archive:
        config = ElementTree.fromstring(archive.read("Metadata/Slic3r_PE_model.config"))  # noqa: S314
    (whole,) = model_xml(file).findall(f"{CORE}resources/{CORE}object")
    (entry,) = config.findall("object")
    assert entry.get("id") == whole.get("id")
    first = 0
    for number, (part, volume) in enumerate(zip(PARTS, entry.findall("volume"), strict=True), start=1):
        assert (volume.get("firstid"), volume.get("lastid")) == (str(first), str(first + len(part.triangles) - 1))
        told = {data.get("key"): data.get("value") for data in volume.findall("metadata")}
        assert (told["name"], told["extruder"]) == (part.name, str(number))
        first += len(part.triangles)


def test_the_archive_is_sound_without_dates_and_the_second_file_is_the_same(file: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(file) as archive:
        assert archive.testzip() is None
        assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
        assert archive.namelist()[0] == "[Content_Types].xml"
    write_3mf(tmp_path / "again.3mf", PARTS, name="first & last")
    assert file.read_bytes() == (tmp_path / "again.3mf").read_bytes()


def test_parts_are_untouched(tmp_path: Path) -> None:
    before = [part.points.copy() for part in PARTS]
    write_3mf(tmp_path / "pair.3mf", PARTS, name="pair")
    for part, points in zip(PARTS, before, strict=True):
        np.testing.assert_array_equal(part.points, points)


@pytest.mark.parametrize("name", ['"<&>"', "Grüße, 世界", "tab\tnew\nline", "bell\x07", "half\udc80"])
def test_any_name_gives_sound_xml(tmp_path: Path, name: str) -> None:
    write_3mf(tmp_path / "pair.3mf", PARTS, name=name)
    (whole,) = model_xml(tmp_path / "pair.3mf").findall(f"{CORE}resources/{CORE}object")
    assert whole.get("name") == name.replace("\x07", "?").replace("\udc80", "?")


@pytest.mark.parametrize("parts", [(), (Part("empty", np.zeros((0, 3)), np.zeros((0, 3))),)])
def test_nothing_to_write_is_an_error(tmp_path: Path, parts: tuple[Part, ...]) -> None:
    with pytest.raises(ValueError, match="expected parts with triangles"):
        write_3mf(tmp_path / "pair.3mf", parts, name="pair")
    assert not list(tmp_path.iterdir())


def slicer(*arguments: str) -> str:
    program = shutil.which("prusa-slicer")
    if program is None:
        pytest.skip("prusa-slicer IS MISSING, nothing was judged: install the package prusa-slicer")
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout


@pytest.mark.slicer
def test_a_slicer_finds_one_object_of_two_parts_in_their_places_and_nothing_to_repair(file: Path) -> None:
    info = slicer("--info", str(file))
    assert info.count("manifold = yes") == 1
    assert re.search(r"^number_of_parts = *2$", info, re.MULTILINE)
    for repair in ("open_edges", "facets_reversed", "facets_removed", "edges_fixed"):
        assert repair not in info
    sizes = [float(size) for size in re.findall(r"size_[xyz] = (.*)", info)]
    points = np.concatenate([part.points for part in PARTS])
    np.testing.assert_allclose(sizes, np.ptp(points, axis=0), atol=1e-4)


@pytest.mark.slicer
@pytest.mark.slow
def test_a_slicer_prints_each_part_with_its_own_extruder_at_its_own_height(file: Path, tmp_path: Path) -> None:
    two = ("--nozzle-diameter", "0.4,0.4", "--filament-diameter", "1.75,1.75", "--temperature", "200,200")
    out = tmp_path / "out.gcode"
    slicer("--export-gcode", "--dont-arrange", "--skirts", "0", *two, "-o", str(out), str(file))
    heights = extruded_heights(out.read_text())
    low = min(part.points[:, 2].min() for part in PARTS)
    for part, tool in zip(PARTS, ("T0", "T1"), strict=True):
        assert heights[tool][0] == pytest.approx(part.points[:, 2].min() - low, abs=0.7)  # a layer, and the first one
        assert heights[tool][1] == pytest.approx(part.points[:, 2].max() - low, abs=0.7)


def extruded_heights(gcode: str) -> dict[str, tuple[float, float]]:
    """Return the lowest and highest z at which each tool extrudes on the way, mm."""
    tool, z, found = "T0", 0.0, dict[str, list[float]]()
    for line in gcode.splitlines():
        if re.match(r"T[01]\b", line):
            tool = line[:2]
        if height := re.match(r"G1 Z([\d.]+)", line):
            z = float(height[1])
        if re.match(r"G1 X\S+ Y\S+ E\d*\.?\d+", line):
            found.setdefault(tool, []).append(z)
    return {tool: (min(heights), max(heights)) for tool, heights in found.items()}
