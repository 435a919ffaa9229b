"""PLY: text and both byte orders give the same polygons, and data that do not fit the header are refused."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.errors import ReadError
from fabricate.formats.limits import ReadLimits
from fabricate.formats.read_ply import read_ply, read_ply_attribute
from fabricate.mesh.polygon_mesh import PolygonMesh

FORMATS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
CODES = {
    "char": "b",
    "uchar": "B",
    "short": "h",
    "ushort": "H",
    "int": "i",
    "uint": "I",
    "float": "f",
    "double": "d",
}
CODES |= {"int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "float32": "f"}
CODES |= {"float64": "d"}

POINTS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1)]
FACES = [[3, 2, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]

Row = list[float | list[int] | list[float]]
Element = tuple[str, list[str], list[Row]]

VERTEX: Element = ("vertex", ["float x", "float y", "float z"], [list(point) for point in POINTS])
FACE: Element = ("face", ["list uchar int vertex_indices"], [[face] for face in FACES])


def written(elements: list[Element], form: str) -> bytes:
    header = ["ply", f"format {form} 1.0", "comment by hand end_header", "obj_info none"]
    body = b""
    for name, properties, rows in elements:
        header += [f"element {name} {len(rows)}", *(f"property {declared}" for declared in properties)]
        body += b"".join(row_bytes(properties, row, FORMATS[form]) for row in rows)
    return "\n".join([*header, "end_header", ""]).encode() + body


def row_bytes(properties: list[str], row: Row, order: str) -> bytes:
    pieces: list[tuple[str, float]] = []
    for declared, value in zip(properties, row, strict=True):
        words = declared.split()
        items = value if isinstance(value, list) else [value]
        pieces += [(CODES[words[1]], len(items))] if words[0] == "list" else []
        pieces += [(CODES[words[-2]], item) for item in items]
    if not order:
        return (" ".join(repr(value) for _, value in pieces) + " \n").encode()
    return b"".join(struct.pack(order + code, value if code in "fd" else int(value)) for code, value in pieces)


def face_lists(mesh: PolygonMesh) -> list[list[int]]:
    return [part.tolist() for part in np.split(mesh.corners, mesh.offsets[1:-1])]


def assert_pyramid(content: bytes) -> None:
    mesh = read_ply(content)
    assert face_lists(mesh) == FACES
    np.testing.assert_array_equal(mesh.points, POINTS)


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize(
    "elements",
    [
        [VERTEX, FACE],
        [FACE, VERTEX],
        [("material", [], []), VERTEX, ("edge", ["int a", "int b"], [[0, 1], [1, 2]]), FACE],
        [("chain", ["list uint short at", "char end"], [[[1, 2, 3], 7], [[], 8], [[9], -9]]), VERTEX, FACE],
        [("tag", ["list uchar uchar word"], 3 * [[[1, 2]]]), VERTEX, FACE],
        [VERTEX, FACE, ("after", ["double weight"], [[0.5]])],
    ],
    ids=["plain", "faces-first", "edges", "ragged-lists", "even-lists", "after"],
)
def test_other_elements_are_passed_over(elements: list[Element], form: str) -> None:
    assert_pyramid(written(elements, form))


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("coordinate", ["char", "float", "double", "float32", "float64", "int16"])
@pytest.mark.parametrize("index", ["uchar", "short", "uint", "int32", "uint16", "float"])
@pytest.mark.parametrize("length", ["uchar", "int", "ushort", "int8"])
def test_every_number_type_is_read(form: str, coordinate: str, index: str, length: str) -> None:
    whole_points: list[Row] = [[2 * x, 2 * y, 2 * z] for x, y, z in POINTS]
    vertex: Element = ("vertex", [f"{coordinate} {axis}" for axis in "xyz"], whole_points)
    face: Element = ("face", [f"list {length} {index} vertex_index"], FACE[2])
    mesh = read_ply(written([vertex, face], form))
    np.testing.assert_array_equal(mesh.points, np.multiply(2, POINTS))
    assert face_lists(mesh) == FACES


@pytest.mark.parametrize("form", FORMATS)
def test_other_properties_are_passed_over_on_both_sides(form: str) -> None:
    vertex: Element = (
        "vertex",
        ["uchar red", "double z", "float nx", "float x", "list uchar int near", "float y"],
        [[255, z, 0.5, x, [1] * number, y] for number, (x, y, z) in enumerate(POINTS)],
    )
    face: Element = (
        "face",
        ["short group", "list uchar float texcoord", "list int uint vertex_indices", "uchar red"],
        [[-number, [0.25] * (number % 3), face, 9] for number, face in enumerate(FACES)],
    )
    assert_pyramid(written([vertex, face], form))


@given(st.data())
@pytest.mark.parametrize("form", FORMATS)
def test_any_polygons_come_back(form: str, data: st.DataObject) -> None:
    number = data.draw(st.integers(3, 9))
    points = data.draw(st.lists(st.tuples(*3 * [st.floats(-1e6, 1e6)]), min_size=number, max_size=number))
    corners = st.lists(st.integers(0, number - 1), min_size=3, max_size=number)
    faces = data.draw(st.lists(corners, min_size=1, max_size=6))
    vertex: Element = ("vertex", ["double x", "double y", "double z"], [list(point) for point in points])
    face: Element = ("face", ["list uchar int vertex_indices"], [[face] for face in faces])
    mesh = read_ply(written([vertex, face], form))
    np.testing.assert_array_equal(mesh.points, points)
    assert face_lists(mesh) == faces


@pytest.mark.parametrize("newline", [b"\r\n", b"\r", b" \n"])
@pytest.mark.parametrize("form", FORMATS)
def test_header_may_end_its_lines_in_any_way(form: str, newline: bytes) -> None:
    header, end, body = written([VERTEX, FACE], form).rpartition(b"end_header\n")
    assert_pyramid((header + end).replace(b"\n", newline) + body)


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("element", ["vertex", "face"])
@pytest.mark.parametrize("count", [100, 353535235358, 10**18 - 1])
def test_counts_larger_than_the_file_are_refused(form: str, element: str, count: int) -> None:
    content = written([VERTEX, FACE], form).replace(
        f"element {element} 5".encode(), f"element {element} {count}".encode()
    )
    with pytest.raises(ReadError):
        read_ply(content)


@pytest.mark.parametrize("form", FORMATS)
def test_every_cut_file_is_refused(form: str) -> None:
    content = written([VERTEX, FACE], form).rstrip(b"\n ")
    begin = content.index(b"end_header\n")
    for length in range(begin, len(content)):
        with pytest.raises(ReadError):
            read_ply(content[:length])


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("float y", "float q", "a property 'y' of element 'vertex' was expected, found x, q, z"),
        (
            "vertex_indices",
            "indices",
            "a list property 'vertex_indices' of 'face' was expected, found indices",
        ),
        ("element face", "element polygon", "found only 5 vertex, 5 polygon"),
        ("element vertex", "element point", "found only 5 point, 5 face"),
        ("0.5 0.5 1", "0.5 half 1", "line 16: a number was expected, found 'half'"),
        ("0.5 0.5 1", "0.5 0.5", "line 16: .* would have 3 numbers here, found 2"),
        ("3 0 1 4", "3 0 1 4 4", "line 18: .* would have 4 numbers here, found 5"),
        ("3 0 1 4", "4 0 1 4", "line 18: .* would have 5 numbers here, found 4"),
        ("3 0 1 4", "-3 0 1 4", "line 18: the length of a list of 'face' was expected"),
        ("3 0 1 4", "1e18 0 1 4", "line 18: the length of a list of 'face' was expected"),
        ("3 0 1 4", "3 0 1 4.5", "line 18: a point index was expected, found 4.5"),
    ],
)
def test_faults_of_text_are_named(old: str, new: str, message: str) -> None:
    content = written([VERTEX, FACE], "ascii")
    assert old.encode() in content
    with pytest.raises(ReadError, match=message):
        read_ply(content.replace(old.encode(), new.encode()))


@pytest.mark.parametrize("faces", [FACES, FACES[1:]], ids=["ragged", "even"])
@pytest.mark.parametrize("length", ["char", "int"])
def test_negative_list_length_is_refused(faces: list[list[int]], length: str) -> None:
    face: Element = ("face", [f"list {length} uchar vertex_indices"], [[face] for face in faces])
    content = written([VERTEX, face], "binary_little_endian")
    row, wrong = (struct.pack(f"<{CODES[length]}3B", number, *FACES[2]) for number in (3, -3))
    assert content.count(row) == 1
    with pytest.raises(ReadError, match=r"byte \d+: the length of a list of 'face' was expected"):
        read_ply(content.replace(row, wrong))


@pytest.mark.parametrize("form", FORMATS)
def test_data_that_the_header_does_not_declare_are_refused(form: str) -> None:
    content = written([VERTEX, FACE], form)
    assert_pyramid(content + b" \n")
    with pytest.raises(ReadError, match="after all rows that the header declares"):
        read_ply(content.replace(b"element face 5", b"element face 4"))


@pytest.mark.parametrize("form", FORMATS)
def test_files_without_faces_say_what_is_there(form: str) -> None:
    edges: Element = ("edge", ["int a", "int b"], [[0, 1]])
    with pytest.raises(ReadError, match="found only 5 vertex, 1 edge, 0 face"):
        read_ply(written([VERTEX, edges, ("face", FACE[1], [])], form))


STRIPS: Element = ("tristrips", ["list int int vertex_indices"], [[[0, 3, 1, 2, -1, 4, 0, 1]], [[4, 1, 2]]])
STRIP_FACES = [[0, 3, 1], [1, 3, 2], [4, 0, 1], [4, 1, 2]]


@pytest.mark.parametrize("form", FORMATS)
def test_strips_are_cut_into_triangles_at_minus_ones_and_between_lists(form: str) -> None:
    assert face_lists(read_ply(written([VERTEX, STRIPS], form))) == STRIP_FACES
    assert face_lists(read_ply(written([VERTEX, STRIPS, FACE], form))) == FACES + STRIP_FACES


def test_triangles_in_strips_count_as_faces() -> None:
    content = written([VERTEX, STRIPS], "binary_little_endian")
    assert len(read_ply(content, limits=ReadLimits(max_faces=4)).offsets) == 5
    with pytest.raises(ReadError, match=r"prepare\.max_faces"):
        read_ply(content, limits=ReadLimits(max_faces=3))


@pytest.mark.parametrize("form", FORMATS)
def test_a_header_without_end_is_not_looked_for_in_the_whole_file(form: str) -> None:
    content = written([VERTEX, FACE], form).replace(b"comment", b"comment " + b"x" * 100_000)
    with pytest.raises(ReadError, match="'end_header' within 65536 bytes, found none"):
        read_ply(content)


@pytest.mark.parametrize("form", FORMATS)
def test_values_of_points_are_read_by_their_name(form: str) -> None:
    kinds = ["float x", "double heat", "float y", "list uchar int some", "float z", "uchar red"]
    rows = [[x, 10.5 * k, y, [1, 2], z, k] for k, (x, y, z) in enumerate(POINTS)]
    content = written([("vertex", kinds, rows), FACE], form)
    assert read_ply_attribute(content, "heat").values.tolist() == [0.0, 10.5, 21.0, 31.5, 42.0]
    found = read_ply_attribute(content, "red")
    assert found.values.tolist() == [0, 1, 2, 3, 4]
    assert found.mesh.points.tolist() == read_ply(content).points.tolist()
    for name in ("cold", "some", "x"):
        with pytest.raises(ReadError, match=rf"'{name}' of the points was expected, found heat, red$"):
            read_ply_attribute(content, name)


def test_without_values_none_are_named() -> None:
    with pytest.raises(ReadError, match="found none beside their coordinates"):
        read_ply_attribute(written([VERTEX, FACE], "ascii"), "heat")
