"""Reading any file: the contents decide, real files come back whole, and rubbish is refused in one line."""

from __future__ import annotations

import csv
import os
from pathlib import Path

import numpy as np
import pytest
from mesh_bytes import (
    ALL,
    FACES,
    INDEXED,
    POINTS,
    TEXTS,
    Writer,
    binary_ply,
    binary_stl,
    glb,
    obj,
    off,
    ply,
    ply_with_values,
    stl,
    three_mf,
)

from fabricate.errors import FabricateError, ReadError
from fabricate.formats.limits import ReadLimits
from fabricate.formats.reading import read_attribute, read_mesh
from fabricate.mesh.closed import checked_closed
from fabricate.mesh.polygon_mesh import PolygonMesh

CORPUS = os.environ.get("FABRICATE_CORPUS")
GOOD = sorted(Path(CORPUS, "good").iterdir()) if CORPUS else []
BAD = sorted(Path(CORPUS, "bad").iterdir()) if CORPUS else []
with_corpus = pytest.mark.skipif(not CORPUS, reason="FABRICATE_CORPUS is not set")

TRIANGLES = np.array([point.split() for point in POINTS], dtype=np.float32)[FACES]


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
@pytest.mark.parametrize("value", ["nan", "inf", "-inf", "1.1e45", "-3.4e60"])
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
        (three_mf, "none and 0 points"),
        (glb, "none and 0 points"),
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
    assert_content_refused(tmp_path, b"v 0 0 0", r"cannot be read \(Permission denied\)", "locked.obj")


def test_large_file_is_refused_before_it_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "large.obj"
    path.write_bytes(obj(POINTS, FACES))
    size = path.stat().st_size
    assert_tetrahedron(read_mesh(path, limits=ReadLimits(max_bytes=size)))
    monkeypatch.delattr(Path, "read_bytes")
    with pytest.raises(ReadError, match=r"large\.obj: .*prepare\.max_file_mb"):
        read_mesh(path, limits=ReadLimits(max_bytes=size - 1))


@pytest.mark.parametrize("writer", ALL)
def test_every_format_counts_faces_and_points_against_the_limits(tmp_path: Path, writer: Writer) -> None:
    path = tmp_path / "file"
    path.write_bytes(writer(POINTS, FACES))
    assert_tetrahedron(read_mesh(path, limits=ReadLimits(max_faces=len(FACES))))
    with pytest.raises(ReadError, match=r"prepare\.max_faces"):
        read_mesh(path, limits=ReadLimits(max_faces=len(FACES) - 1))
    if writer not in {stl, binary_stl}:
        path.write_bytes(writer(4 * POINTS, FACES))
        with pytest.raises(ReadError, match=r"at most 12 points.*prepare\.max_faces"):
            read_mesh(path, limits=ReadLimits(max_faces=len(FACES)))


@pytest.mark.parametrize(
    ("content", "name", "words"),
    [
        (b"PK\x03\x04" + bytes(100), "a.obj", "no whole zip archive"),
        (b"PK\x05\x06" + bytes(18), "a.3mf", "a part '3d/3dmodel.model' was expected"),
        (b"PK\x05\x06" + bytes(18), "a", "without an extension"),
        (b"glTF" + bytes(100), "a.ply", "a GLB file of version 2 was expected, found version 0"),
        (b"words", "a.3mf", "no whole zip archive"),
        (b"words", "a.glb", "a GLB header of 12 bytes"),
        (b"words that are not glb", "a.glb", "begin with 'glTF'"),
        (b"some words", "a", "without an extension"),
        (b"x", "a", "without an extension"),
        (b"1 2 3\n4 5 6\n", "a.xyz", "a 3MF, GLB, OBJ, OFF, PLY or STL mesh was expected, found a file named '.xyz'"),
        (bytes(100), "a.obj", "faces"),
        (b"\1" + bytes(100), "a.off", "a number was expected"),
        (b"\1" + bytes(100), "a.ply", "line 'ply'"),
        (b"\1" + bytes(100), "a.stl", "bytes"),
    ],
)
def test_other_kinds_of_files_are_refused(tmp_path: Path, content: bytes, name: str, words: str) -> None:
    assert_content_refused(tmp_path, content, words, name)


@with_corpus
@pytest.mark.parametrize("path", GOOD, ids=lambda path: path.name)
def test_good_files_keep_every_polygon(path: Path) -> None:
    catalogue = Path(CORPUS or "", "catalogue.csv").read_text(encoding="utf-8").splitlines()
    row = next(row for row in csv.DictReader(catalogue) if row["name"] == path.name)
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


def test_attributes_are_read_of_ply_files_only(tmp_path: Path) -> None:
    path = tmp_path / "some.ply"
    path.write_bytes(ply_with_values("heat", [1, 2, 3.5, 4]))
    assert read_attribute(path, "heat").values.tolist() == [1, 2, 3.5, 4]
    for content, words in [
        (obj(POINTS, FACES), "only PLY files have attributes"),
        (ply(POINTS, FACES), "found none beside their coordinates"),
        (ply_with_values("heat", [1, float("nan"), 3, 4]), "but is none at 1 points"),
        (b"", "the file is empty"),
    ]:
        path.write_bytes(content)
        with pytest.raises(ReadError, match=words) as caught:
            read_attribute(path, "heat")
        assert str(caught.value).startswith(f"{path}: ")
