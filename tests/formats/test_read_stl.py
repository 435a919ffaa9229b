"""STL: binary and text give the same welded triangles, and sizes that do not add up are refused."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.errors import ReadError
from fabricate.formats.read_stl import is_binary_stl, read_stl
from fabricate.mesh.polygon_mesh import PolygonMesh

TETRAHEDRON = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])[
    [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
].astype(np.float32)


def binary(corners: np.ndarray, *, header: bytes = b"made by hand") -> bytes:
    triangles = np.zeros(len(corners), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    triangles["corners"] = corners
    return header.ljust(80, b"\0") + len(corners).to_bytes(4, "little") + triangles.tobytes()


def text(corners: np.ndarray, *, name: str = "body") -> str:
    lines = [f"solid {name}"]
    for triangle in corners.tolist():
        vertices = [f"      vertex {x!r} {y!r} {z!r}" for x, y, z in triangle]
        lines += ["  facet normal 0 0 0", "    outer loop", *vertices, "    endloop", "  endfacet"]
    return "\n".join([*lines, f"endsolid {name}", ""])


def triangles(mesh: PolygonMesh) -> np.ndarray:
    return mesh.points[mesh.corners.reshape(-1, 3)]


def assert_tetrahedron(content: bytes) -> None:
    mesh = read_stl(content)
    np.testing.assert_array_equal(triangles(mesh), TETRAHEDRON)
    assert len(mesh.points) == 4
    assert mesh.face_sizes.tolist() == [3, 3, 3, 3]


@pytest.mark.parametrize("header", [b"", b"solid by some program", b"solid facet normal", b"\0" * 80])
def test_binary_is_known_by_its_size_whatever_the_header_says(header: bytes) -> None:
    assert is_binary_stl(binary(TETRAHEDRON, header=header))
    assert_tetrahedron(binary(TETRAHEDRON, header=header))


@pytest.mark.parametrize(
    "content",
    [
        text(TETRAHEDRON),
        text(TETRAHEDRON).upper(),
        text(TETRAHEDRON).replace("\n", "\r\n"),
        text(TETRAHEDRON).replace("\n", "\r"),
        text(TETRAHEDRON).replace("    ", "\t"),
        text(TETRAHEDRON, name="facet of a vertex"),
        text(TETRAHEDRON, name=""),
        "\n" + text(TETRAHEDRON[:2]) + text(TETRAHEDRON[2:]),
        text(TETRAHEDRON).replace("facet normal 0 0 0", "facet normal nan -nan(ind) 0"),
        text(TETRAHEDRON)[: -len("endsolid body\n")],
    ],
)
def test_text_in_every_spelling_is_the_same_tetrahedron(content: str) -> None:
    assert not is_binary_stl(content.encode())
    assert_tetrahedron(content.encode())


@given(st.lists(st.tuples(*3 * [st.integers(0, 7)]), min_size=1, max_size=12), st.booleans())
def test_welding_merges_equal_corners_only_and_numbers_them_as_they_appear(
    soup: list[tuple[int, int, int]], as_text: bool
) -> None:
    places = np.random.default_rng(3).normal(size=(8, 3)).astype(np.float32)
    corners = places[np.array(soup)]
    mesh = read_stl(text(corners).encode() if as_text else binary(corners))
    np.testing.assert_array_equal(triangles(mesh), corners)
    first_seen = list(dict.fromkeys(np.ravel(soup).tolist()))
    np.testing.assert_array_equal(mesh.points, places[first_seen])


def test_neighbouring_floats_stay_apart_and_signed_zeros_do_not() -> None:
    above_two = np.nextafter(np.float32(2), np.float32(3))
    places = [[0, 1, 1], [2, 2, 2], [3, 3, 3], [-0.0, 1, 1], [above_two, 2, 2], [3, 3, 3]]
    mesh = read_stl(binary(np.array(places, dtype=np.float32).reshape(2, 3, 3)))
    assert mesh.corners.tolist() == [0, 1, 2, 0, 3, 2]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (binary(TETRAHEDRON)[:-1], "4 triangles, which take 284 bytes, but the file has 283"),
        (binary(TETRAHEDRON) + b"\0", "4 triangles, which take 284 bytes, but the file has 285"),
        (binary(TETRAHEDRON, header=b"solid x")[:-50], "which take 284 bytes, but the file has 234"),
        (b"solid", "5 bytes are too few"),
        (text(TETRAHEDRON)[:250].encode(), "line 9: a facet .* was expected"),
        (text(TETRAHEDRON).replace("      vertex 0.0 0.0 1.0\n", "", 1).encode(), "line 9: a facet"),
        (text(TETRAHEDRON).replace("0.0 0.0 1.0", "0.0 0.0", 1).encode(), "line 9: a facet"),
        (text(TETRAHEDRON).replace("0.0 0.0 1.0", "0.0 0.0 one", 1).encode(), "line 9: .* not a number"),
    ],
)
def test_faults_are_named(content: bytes, message: str) -> None:
    with pytest.raises(ReadError, match=message):
        read_stl(content)


@pytest.mark.parametrize("content", [binary(TETRAHEDRON[:0]), text(TETRAHEDRON[:0]).encode()])
def test_no_triangles_are_an_empty_mesh(content: bytes) -> None:
    mesh = read_stl(content)
    assert len(mesh.points) == 0
    assert mesh.offsets.tolist() == [0]
