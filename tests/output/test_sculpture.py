"""The files of one sculpture: all there, holding the same parts, and the same bytes each time."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from fabricate.checks.judge import read_part
from fabricate.errors import OutputError
from fabricate.output.sculpture import write_sculpture
from fabricate.solid.part import Part

FILES = {"yellow.stl", "blue.stl", "pair.3mf", "preview.glb", "preview.png", "curve.ply"}
CURVE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.5]], dtype=float)


def ball(name: str, *, x: float) -> Part:
    mesh = trimesh.creation.icosphere(subdivisions=1, radius=5.0)
    return Part(name, mesh.vertices + np.array([x, 0, 0]), mesh.faces)


PARTS = (ball("yellow", x=-6.0), ball("blue", x=6.0))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("sculpture")
    write_sculpture(place, PARTS, [CURVE], name="balls")
    return place


def test_every_file_is_there(folder: Path) -> None:
    assert {path.name for path in folder.iterdir()} == FILES
    assert all(path.stat().st_size > 0 for path in folder.iterdir())


def test_stl_paths_are_returned_in_the_order_of_the_parts(tmp_path: Path) -> None:
    paths = write_sculpture(tmp_path, PARTS, [CURVE], name="balls")
    assert paths == (tmp_path / "yellow.stl", tmp_path / "blue.stl")


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.name)
def test_parts_come_back_as_they_were(folder: Path, part: Part) -> None:
    found = read_part(folder / f"{part.name}.stl")
    assert (found.points[found.triangles] == part.points[part.triangles]).all()


def test_the_pair_holds_every_triangle(folder: Path) -> None:
    with zipfile.ZipFile(folder / "pair.3mf") as archive:
        model = archive.read("3D/3dmodel.model").decode()
    assert len(re.findall(r"<triangle ", model)) == sum(len(part.triangles) for part in PARTS)


def test_the_picture_shows_something(folder: Path) -> None:
    with Image.open(folder / "preview.png") as image:
        colours = image.convert("RGB").getcolors(maxcolors=1 << 24)
    assert colours is not None
    assert len(colours) > 100


def test_same_parts_same_bytes(folder: Path, tmp_path: Path) -> None:
    write_sculpture(tmp_path, PARTS, [CURVE], name="balls")
    for name in FILES:
        assert (tmp_path / name).read_bytes() == (folder / name).read_bytes(), name


def test_a_place_that_is_not_there_is_one_readable_line(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"yellow\.stl") as caught:
        write_sculpture(tmp_path / "none", PARTS, [CURVE], name="balls")
    assert "\n" not in str(caught.value)
