"""GLB: triangles, strips and fans of the whole scene, welded along the seams of normals and colours."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import trimesh
from mesh_bytes import FACES, POINTS, accessor, coordinates, glb, glb_bytes, gltf

from fabricate.errors import ReadError
from fabricate.formats.limits import ReadLimits
from fabricate.formats.read_glb import read_glb
from fabricate.mesh.closed import checked_closed, signed_volume
from fabricate.mesh.polygon_mesh import PolygonMesh

PLACES = coordinates(POINTS, "<f4")
VIEW = accessor(0, 4, 5126, "VEC3")
PART: dict[str, Any] = {"attributes": {"POSITION": 0}}


def written(points: np.ndarray, indices: list[int] | None, *, mode: int = 4, **more: Any) -> bytes:
    data = points.astype("<f4").tobytes()
    accessors = [accessor(0, len(points), 5126, "VEC3")]
    primitive = {**PART, "mode": mode}
    if indices is None:
        return glb_bytes(gltf(accessors, [len(data)], [[primitive]], **more), data)
    corners = np.array(indices, dtype="<u4").tobytes()
    accessors.append(accessor(1, len(indices), 5125, "SCALAR"))
    document = gltf(accessors, [len(data), len(corners)], [[{**primitive, "indices": 1}]], **more)
    return glb_bytes(document, data + corners)


def triangles(mesh: PolygonMesh) -> list[list[list[float]]]:
    return np.asarray(mesh.points[mesh.corners.reshape(-1, 3)]).tolist()


def test_points_that_are_split_at_seams_become_one() -> None:
    apart = PLACES[np.ravel(FACES)]
    for content in (written(apart, None), written(apart, list(range(12))), glb(POINTS, FACES)):
        mesh = checked_closed(read_glb(content))
        assert len(mesh.points) == 4
        assert triangles(mesh) == PLACES[np.array(FACES)].tolist()


def test_strips_and_fans_are_triangles() -> None:
    assert triangles(read_glb(written(PLACES, [0, 1, 2, 3], mode=5))) == PLACES[[[0, 1, 2], [2, 1, 3]]].tolist()
    assert triangles(read_glb(written(PLACES, [0, 1, 2, 3], mode=6))) == PLACES[[[0, 1, 2], [0, 2, 3]]].tolist()
    assert triangles(read_glb(written(PLACES, None, mode=5))) == PLACES[[[0, 1, 2], [2, 1, 3]]].tolist()


@pytest.mark.parametrize("mode", [0, 1, 2, 3])
def test_points_and_lines_are_passed_over(mode: int) -> None:
    assert len(read_glb(written(PLACES, [0, 1, 2, 3], mode=mode)).corners) == 0


def test_nodes_place_meshes_and_mirrors_keep_the_outside() -> None:
    nodes = [{"mesh": 0, "translation": [5, 0, 0]}, {"mesh": 0, "scale": [-2, 1, 1]}]
    mesh = read_glb(written(PLACES, np.ravel(FACES).tolist(), nodes=nodes, scenes=[{"nodes": [0, 1]}]))
    assert len(mesh.points) == 8
    assert signed_volume(mesh) == pytest.approx(1 / 6 + 2 / 6)
    assert [mesh.points[:, 0].min(), mesh.points[:, 0].max()] == [-2, 6]


def test_what_several_primitives_share_is_whole_and_no_unused_point_is_left() -> None:
    data = PLACES.tobytes() + np.array(FACES, dtype="<u2").tobytes()
    accessors = [VIEW, *(accessor(1, 6, 5123, "SCALAR", byteOffset=12 * half) for half in (0, 1))]
    halves = [{**PART, "indices": 1, "material": 0}, {**PART, "indices": 2, "material": 1}]
    mesh = checked_closed(read_glb(glb_bytes(gltf(accessors, [48, 24], [halves]), data)))
    assert len(mesh.points) == 4
    one = read_glb(glb_bytes(gltf([VIEW, accessor(1, 3, 5123, "SCALAR")], [48, 6], [[{**PART, "indices": 1}]]), data))
    assert len(one.points) == 3


def test_what_another_program_writes_has_its_volume() -> None:
    made = trimesh.creation.annulus(r_min=1, r_max=2, height=1, sections=24)
    placed = trimesh.Scene()
    placed.add_geometry(made, transform=trimesh.transformations.rotation_matrix(1, [1, 2, 3], [4, 5, 6]))
    mesh = checked_closed(read_glb(placed.export(file_type="glb")))
    assert signed_volume(mesh) == pytest.approx(made.volume, rel=1e-4)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (written(PLACES, [0, 1, 2, 3]), "accessor 1 was expected to hold whole triangles, found 4 corners"),
        (written(PLACES, [0, 1, 4]), "accessor 1 refers to point 4"),
        (written(PLACES, [0, 1, 2], nodes=[{"mesh": 1}]), "refers to mesh 1"),
        (written(PLACES, [0, 1, 2], extensionsRequired=["KHR_draco_mesh_compression"]), "KHR_draco_mesh_compression"),
        (written(PLACES, [0, 1, 2], extensionsRequired=["EXT_meshopt_compression"]), "EXT_meshopt_compression"),
        (glb_bytes(gltf([], [], [[PART]]), b""), "refers to accessor 0"),
        (glb_bytes(gltf([{**VIEW, "count": 3}], [48], [[PART]]), b""), "48, but the file has 0 bytes of data"),
    ],
    ids=lambda value: value if isinstance(value, str) and len(value) < 80 else "",
)
def test_faults_are_named(content: bytes, words: str) -> None:
    with pytest.raises(ReadError, match=words):
        read_glb(content)


def test_other_extensions_are_passed_over() -> None:
    more = {"extensionsRequired": ["KHR_mesh_quantization", "KHR_texture_transform"]}
    assert triangles(read_glb(written(PLACES, [0, 1, 2], **more))) == PLACES[[[0, 1, 2]]].tolist()


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (written(PLACES, 3 * [0, 1, 2], nodes=2 * [{"mesh": 0}]), r"at most 5 faces .*prepare\.max_faces"),
        (glb_bytes(gltf(2 * [{**VIEW, "count": 9}], [1], [[PART, {"attributes": {"POSITION": 1}}]]), b""), "faces"),
        (glb_bytes(gltf([{**VIEW, "count": 2**31}], [48], [[PART]]), bytes(48)), "whole triangles"),
        (glb_bytes(gltf([{**VIEW, "count": 3 * 2**29}], [48], [[PART]]), bytes(48)), r"prepare\.max_faces"),
        (written(np.zeros((16, 3)), [0, 1, 2]), r"at most 15 points .*prepare\.max_faces"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_counts_are_held_against_the_limits_before_anything_is_read(content: bytes, words: str) -> None:
    with pytest.raises(ReadError, match=words):
        read_glb(content, limits=ReadLimits(max_faces=5))


def test_primitives_without_end_are_refused() -> None:
    nodes = 50_001 * [{"mesh": 0}]
    empty = accessor(0, 0, 5126, "VEC3")
    content = glb_bytes(gltf([empty], [0], [[PART, PART]], nodes=nodes), b"")
    with pytest.raises(ReadError, match="at most 100000 placed primitives"):
        read_glb(content)
