"""Reading any file: the contents decide, real files come back whole, and rubbish is refused in one line."""

from __future__ import annotations

import csv
import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fabricate.errors import FabricateError, ReadError
from fabricate.mesh.closed import checked_closed
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.reading import read_mesh

CORPUS = os.environ.get("FABRICATE_CORPUS")
GOOD = sorted(Path(CORPUS, "good").iterdir()) if CORPUS else []
BAD = sorted(Path(CORPUS, "bad").iterdir()) if CORPUS else []
with_corpus = pytest.mark.skipif(not CORPUS, reason="FABRICATE_CORPUS is not set")

POINTS = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"]
FACES = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
TRIANGLES = np.array([point.split() for point in POINTS], dtype=np.float32)[FACES]


def obj(points: list[str], faces: list[list[int]]) -> bytes:
    rows = [" ".join(str(corner + 1) for corner in face) for face in faces]
    return "".join([*(f"v {point}\n" for point in points), *(f"f {row}\n" for row in rows)]).encode()


def rows(points: list[str], faces: list[list[int]]) -> str:
    return "\n".join([*points, *(" ".join(map(str, [len(face), *face])) for face in faces)]) + "\n"


def off(points: list[str], faces: list[list[int]]) -> bytes:
    return f"OFF\n{len(points)} {len(faces)} 0\n{rows(points, faces)}".encode()


def ply_header(form: str, points: int, faces: int) -> str:
    coordinates = "".join(f"property float {axis}\n" for axis in "xyz")
    lists = "property list uchar int vertex_indices\n"
    elements = f"element vertex {points}\n{coordinates}element face {faces}\n{lists}"
    return f"ply\nformat {form} 1.0\n{elements}end_header\n"


def ply(points: list[str], faces: list[list[int]]) -> bytes:
    return (ply_header("ascii", len(points), len(faces)) + rows(points, faces)).encode()


def binary_ply(points: list[str], faces: list[list[int]]) -> bytes:
    coordinates = np.array([point.split() for point in points], dtype="<f4")
    lists = b"".join(bytes([len(face)]) + np.array(face, dtype="<i4").tobytes() for face in faces)
    header = ply_header("binary_little_endian", len(points), len(faces))
    return header.encode() + coordinates.tobytes() + lists


def stl(points: list[str], faces: list[list[int]]) -> bytes:
    facets = ["".join(f"vertex {points[corner]}\n" for corner in face) for face in faces]
    body = "".join(f"facet normal 0 0 0\nouter loop\n{facet}endloop\nendfacet\n" for facet in facets)
    return f"solid\n{body}endsolid\n".encode()


def binary_stl(points: list[str], faces: list[list[int]]) -> bytes:
    corners = np.array([point.split() for point in points], dtype="<f4")[np.array(faces, dtype=int)]
    triangles = b"".join(bytes(12) + triangle.tobytes() + bytes(2) for triangle in corners)
    return b"solid".ljust(80, b"\0") + len(faces).to_bytes(4, "little") + triangles


RUBBISH = [b"-1", b"99999999999999999999", b"1e400", b"nan", b"\n", b" ", b"0", b"/", b"\\\n", 4 * b"\xff"]
Writer = Callable[[list[str], list[list[int]]], bytes]
TEXTS: list[Writer] = [obj, off, ply, stl]
INDEXED: list[Writer] = [obj, off, ply, binary_ply]
ALL: list[Writer] = [*TEXTS, binary_ply, binary_stl]


def read(folder: Path, content: bytes, name: str = "file") -> PolygonMesh:
    path = folder / name
    path.write_bytes(content)
    return read_mesh(path)


def assert_tetrahedron(mesh: PolygonMesh) -> None:
    np.testing.assert_array_equal(mesh.points[mesh.corners].reshape(4, 3, 3), TRIANGLES)
    assert len(mesh.points) == 4


def assert_refused(path: Path, words: str) -> None:
    with pytest.raises(ReadError, match=words) as caught:
        read_mesh(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)


def assert_content_refused(folder: Path, content: bytes, words: str, name: str = "file") -> None:
    (folder / name).write_bytes(content)
    assert_refused(folder / name, words)


@pytest.mark.parametrize("name", ["a.obj", "a.off", "a.ply", "a.stl", "a.OBJ", "a.txt", "noextension"])
@pytest.mark.parametrize("writer", ALL)
def test_the_contents_decide_whatever_the_name(tmp_path: Path, writer: Writer, name: str) -> None:
    assert_tetrahedron(read(tmp_path, writer(POINTS, FACES), name))


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32"])
@pytest.mark.parametrize("writer", TEXTS)
def test_every_encoding_of_text_is_read(tmp_path: Path, writer: Writer, encoding: str) -> None:
    assert_tetrahedron(read(tmp_path, writer(POINTS, FACES).decode().encode(encoding)))


def test_text_that_stops_being_utf16_is_refused(tmp_path: Path) -> None:
    content = obj(POINTS, FACES).decode().encode("utf-16") + b"\0"
    assert_content_refused(tmp_path, content, "begins as utf-16 text")


def test_extension_helps_where_the_contents_leave_it_open(tmp_path: Path) -> None:
    assert_tetrahedron(read(tmp_path, off(POINTS, FACES).removeprefix(b"OFF\n"), "headless.off"))
    assert_tetrahedron(read(tmp_path, b"# licence\n" * 10_000 + obj(POINTS, FACES), "long_comment.obj"))


@pytest.mark.parametrize("writer", INDEXED)
def test_points_without_faces_are_dropped_and_the_others_keep_their_order(tmp_path: Path, writer: Writer) -> None:
    points = ["9 9 9", POINTS[0], POINTS[1], "nan inf 1e38", POINTS[2], POINTS[3], "8 8 8"]
    mesh = read(tmp_path, writer(points, [[(1, 2, 4, 5)[corner] for corner in face] for face in FACES]))
    assert_tetrahedron(mesh)
    assert mesh.corners.tolist() == np.ravel(FACES).tolist()


@pytest.mark.parametrize("writer", ALL)
@pytest.mark.parametrize("value", ["nan", "inf", "-inf", "1.1e30", "-3.4e38"])
def test_unusable_coordinates_are_refused_with_their_place(tmp_path: Path, writer: Writer, value: str) -> None:
    content = writer([*POINTS[:3], f"0 0 {value}"], FACES)
    assert_content_refused(tmp_path, content, r"points cannot be used: .* found \(0, 0, .* for point 4")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("writer", [binary_ply, binary_stl])
def test_signalling_nan_is_refused_without_a_warning(tmp_path: Path, writer: Writer) -> None:
    content = writer(POINTS, FACES).replace(np.float32(1).tobytes(), b"\0\0\x81\x7f")
    assert_content_refused(tmp_path, content, "cannot be used: .*nan")


@pytest.mark.parametrize("writer", INDEXED)
@pytest.mark.parametrize("index", [-2, 4, 1_000_000])
def test_index_out_of_range_is_refused(tmp_path: Path, writer: Writer, index: int) -> None:
    content = writer(POINTS, [*FACES[:2], [1, 2, index - (writer is obj and index < 0) * 5], FACES[3]])
    assert_content_refused(tmp_path, content, r"(face 3 of 4|line 7: the face) refers to point")


@pytest.mark.parametrize("writer", INDEXED)
@pytest.mark.parametrize("face", [[1, 2], [1]])
def test_face_with_too_few_corners_is_refused(tmp_path: Path, writer: Writer, face: list[int]) -> None:
    content = writer(POINTS, [*FACES[:2], face, FACES[3]])
    assert_content_refused(tmp_path, content, r"(face 3|line 7).* at least 3 corners.* found \d")


@pytest.mark.parametrize(
    ("writer", "found"),
    [
        (obj, "only 4 points and 0 lines"),
        (off, "none and 4 points"),
        (ply, "only 4 vertex, 0 face"),
        (binary_ply, "only 4 vertex, 0 face"),
        (stl, "none and 0 points"),
        (binary_stl, "none and 0 points"),
    ],
)
def test_file_without_faces_says_what_was_found(tmp_path: Path, writer: Writer, found: str) -> None:
    assert_content_refused(tmp_path, writer(POINTS, []), f"were expected, found {found}")


def test_missing_file_folder_and_empty_file_are_told_apart(tmp_path: Path) -> None:
    assert_refused(tmp_path / "missing.obj", "no such file")
    assert_refused(tmp_path, "found a folder")
    assert_refused(Path(os.devnull), "found a device")
    assert_content_refused(tmp_path, b"", "empty")
    assert_content_refused(tmp_path, b" \n\n", "empty")


def test_unreadable_file_is_an_error_of_ours(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_: Path) -> bytes:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "read_bytes", refuse)
    assert_refused(tmp_path / "locked.obj", r"cannot be read \(Permission denied\)")


@pytest.mark.parametrize(
    ("content", "name", "words"),
    [
        (
            b"PK\x03\x04" + bytes(100),
            "a.3mf",
            "an OBJ, OFF, PLY or STL mesh was expected, found a file named '.3mf'",
        ),
        (b"glTF" + bytes(100), "a.glb", "OBJ, OFF, PLY or STL"),
        (b"some words", "a", "without an extension"),
        (b"x", "a", "without an extension"),
        (b"1 2 3\n4 5 6\n", "a.xyz", "OBJ, OFF, PLY or STL"),
        (b"PK\x03\x04" + bytes(100), "a.obj", "faces"),
        (b"PK\x03\x04" + bytes(100), "a.off", "a number was expected"),
        (b"PK\x03\x04" + bytes(100), "a.ply", "line 'ply'"),
        (b"PK\x03\x04" + bytes(100), "a.stl", "bytes"),
    ],
)
def test_other_kinds_of_files_are_refused(tmp_path: Path, content: bytes, name: str, words: str) -> None:
    assert_content_refused(tmp_path, content, words, name)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=150)
@given(st.data())
@pytest.mark.parametrize("writer", ALL)
def test_damaged_files_are_read_or_refused_but_never_crash(tmp_path: Path, writer: Writer, data: st.DataObject) -> None:
    content = bytearray(writer(POINTS, FACES))
    for _ in range(data.draw(st.integers(1, 3))):
        place = data.draw(st.integers(0, len(content)))
        length = data.draw(st.integers(0, 8))
        content[place : place + length] = data.draw(st.binary(max_size=8) | st.sampled_from(RUBBISH))
    try:
        mesh = read(tmp_path, bytes(content), "damaged" + data.draw(st.sampled_from([".obj", ".stl", ""])))
        checked_closed(mesh)
    except FabricateError as error:
        assert "\n" not in str(error)  # noqa: PT017


@with_corpus
@pytest.mark.parametrize("path", GOOD, ids=lambda path: path.name)
def test_good_files_keep_every_polygon(path: Path) -> None:
    catalogue = Path(CORPUS or "", "catalogue.csv").read_text(encoding="utf-8").splitlines()
    row = next(row for row in csv.DictReader(catalogue) if row["name"] == path.name)
    if row["format"].split()[0] not in {"obj", "off", "ply", "stl"}:
        assert_refused(path, "OBJ, OFF, PLY or STL")
        return
    sizes = read_mesh(path).face_sizes
    found = [(sizes == 3).sum(), (sizes == 4).sum(), (sizes > 4).sum()]
    assert found == [int(row[kind]) for kind in ("tris", "quads", "ngons")]


@with_corpus
@pytest.mark.parametrize("path", BAD, ids=lambda path: path.name)
def test_bad_files_are_proved_closed_or_refused_in_one_line(path: Path) -> None:
    try:
        mesh = checked_closed(read_mesh(path))
    except FabricateError as error:
        assert "\n" not in str(error)  # noqa: PT017
        assert len(str(error)) < 500  # noqa: PT017
    else:
        assert isinstance(mesh, PolygonMesh)
