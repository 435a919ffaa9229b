"""GLB: read back by another program, with names, colours, places, and the unit the format has."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh

from fabricate.output.glb import write_glb
from fabricate.picture.palette import linear_light, part_colours
from fabricate.solid.part import Part

BALL = trimesh.creation.icosphere(subdivisions=2, radius=20)
RING = trimesh.creation.torus(30, 6)
BALL.apply_translation([0, 0, 7])
PARTS = (Part("yellow", BALL.vertices, BALL.faces), Part("blue", RING.vertices, RING.faces))


def document(path: Path) -> dict:
    content = path.read_bytes()
    length = int.from_bytes(content[12:16], "little")
    assert content[:4] == b"glTF"
    assert int.from_bytes(content[8:12], "little") == len(content)
    return json.loads(content[20 : 20 + length])


def test_points_and_triangles_come_back_exactly(tmp_path: Path) -> None:
    write_glb(tmp_path / "a.glb", PARTS)
    scene = trimesh.load(tmp_path / "a.glb", process=False)
    for part in PARTS:
        np.testing.assert_array_equal(scene.geometry[part.name].vertices, part.points)
        np.testing.assert_array_equal(scene.geometry[part.name].faces, part.triangles)


def test_in_the_scene_lengths_are_metres_and_up_is_y(tmp_path: Path) -> None:
    write_glb(tmp_path / "a.glb", PARTS)
    scene = trimesh.load(tmp_path / "a.glb", process=False)
    low, high = PARTS[0].points.min(axis=0) / 1000, PARTS[0].points.max(axis=0) / 1000
    (transform, _) = scene.graph["yellow"]
    seated = trimesh.transform_points(PARTS[0].points, transform)
    np.testing.assert_allclose(seated.min(axis=0), [low[0], low[2], -high[1]], atol=1e-9)
    np.testing.assert_allclose(seated.max(axis=0), [high[0], high[2], -low[1]], atol=1e-9)
    assert np.linalg.det(transform[:3, :3]) > 0


def test_materials_have_the_linear_colours_of_the_parts(tmp_path: Path) -> None:
    write_glb(tmp_path / "a.glb", PARTS)
    for material, colour in zip(
        document(tmp_path / "a.glb")["materials"], part_colours(["yellow", "blue"]), strict=True
    ):
        stored = material["pbrMetallicRoughness"]["baseColorFactor"]
        np.testing.assert_allclose(stored, [*linear_light(np.array(colour) / 255), 1], atol=1e-5)


def test_the_buffer_is_described_completely_and_aligned(tmp_path: Path) -> None:
    write_glb(tmp_path / "a.glb", PARTS)
    found = document(tmp_path / "a.glb")
    ends = 0
    for view in found["bufferViews"]:
        assert view["byteOffset"] == ends
        assert view["byteOffset"] % 4 == 0
        ends += view["byteLength"]
    assert found["buffers"] == [{"byteLength": ends}]
    assert found["asset"]["version"] == "2.0"


def test_the_second_file_is_the_same_and_the_parts_are_untouched(tmp_path: Path) -> None:
    before = [part.points.copy() for part in PARTS]
    for name in ("a.glb", "b.glb"):
        write_glb(tmp_path / name, PARTS)
    assert (tmp_path / "a.glb").read_bytes() == (tmp_path / "b.glb").read_bytes()
    for part, points in zip(PARTS, before, strict=True):
        np.testing.assert_array_equal(part.points, points)


@pytest.mark.parametrize("parts", [(), (Part("empty", np.zeros((0, 3)), np.zeros((0, 3))),)])
def test_nothing_to_write_is_an_error(tmp_path: Path, parts: tuple[Part, ...]) -> None:
    with pytest.raises(ValueError, match="expected parts with triangles"):
        write_glb(tmp_path / "a.glb", parts)
    assert not list(tmp_path.iterdir())
