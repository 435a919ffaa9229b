"""OFF: polygons come back as written, colours are passed over, and header counts are never believed."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.errors import ReadError
from fabricate.formats.limits import ReadLimits
from fabricate.formats.read_off import read_off
from fabricate.mesh.polygon_mesh import PolygonMesh

POINTS: list[list[float]] = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]]
FACES = [[3, 2, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]


def written(*, header: str = "OFF\n5 5 8\n", on_points: str = "", on_faces: str = "", end: str = "\n") -> str:
    points = [" ".join(map(str, point)) + on_points for point in POINTS]
    faces = [" ".join(map(str, [len(face), *face])) + on_faces for face in FACES]
    return header + end.join([*points, *faces]) + end


def face_lists(mesh: PolygonMesh) -> list[list[int]]:
    return [part.tolist() for part in np.split(mesh.corners, mesh.offsets[1:-1])]


def assert_pyramid(text: str) -> None:
    mesh = read_off(text.encode())
    assert face_lists(mesh) == FACES
    np.testing.assert_array_equal(mesh.points, POINTS)


@pytest.mark.parametrize(
    "text",
    [
        written(),
        written(header="OFF 5 5 8\n"),
        written(header="# first\n\nOFF # second\n# third\n5 5 8 # fourth\n"),
        written(header="OFF\n5 5\n"),
        written(header="5 5 8\n"),
        written(header="OFF\n5\n5\n0\n"),
        written(end="\n\n"),
        written(end="\r\n", header="OFF\r\n5 5 8\r\n"),
        written(end="\r", header="OFF\r5 5 8\r"),
        written(end=" # 1 2 3\n"),
        written(end=" "),
        written().replace(" ", "\n"),
        written(on_faces=" 0.1 0.2 0.3"),
        written(on_faces="  255 0 0 255"),
        written(header="COFF\n5 5 8\n", on_points=" 255 0 0 255"),
        written(header="NOFF 5 5 8\n", on_points=" 0 0 1"),
        written(header="STCNOFF\n5 5 8\n", on_points=" 0 0 1 1 0 0 1 0.5 0.5"),
        written().rstrip(),
        written(header="off\n5 5 8\n"),
        written(header="OFF\n5\n5 8\n", on_faces=" 0.1 0.2 0.3"),
        written(header="NOFF 5\n5 8 ", on_points="\n0 0 1\n", on_faces=" 255 0 0"),
        written(header="STCNOFF\n5 5 8\n", on_points=" 0 0 1\n1 0 0 1\n0.5 0.5"),
        written(header="COFF\n5 5 8\n", on_points=" 1 0 0 1", end=" "),
    ],
)
def test_every_spelling_is_the_same_pyramid(text: str) -> None:
    assert_pyramid(text)


@given(st.data())
def test_any_polygons_come_back_on_lines_and_off_them(data: st.DataObject) -> None:
    number = data.draw(st.integers(3, 9))
    points = data.draw(st.lists(st.tuples(*3 * [st.floats(-1e6, 1e6)]), min_size=number, max_size=number))
    corners = st.lists(st.integers(0, number - 1), min_size=3, max_size=number)
    faces = data.draw(st.lists(corners, min_size=1, max_size=6))
    rows = [" ".join(map(repr, point)) for point in points]
    rows += [" ".join(map(str, [len(face), *face])) for face in faces]
    for text in ("\n".join(rows), "  ".join(rows)):
        mesh = read_off(f"OFF\n{number} {len(faces)} 0\n{text}".encode())
        np.testing.assert_array_equal(mesh.points, points)
        assert face_lists(mesh) == faces


@pytest.mark.parametrize("counts", ["353535235358 6", "6 353535235358", "9000000000000000000 1", "1e300 1e300"])
def test_absurd_counts_are_refused_before_memory_is_taken(counts: str) -> None:
    text = written(header=f"OFF\n{counts} 0\n").encode()
    tracemalloc.start()
    with pytest.raises(ReadError, match=r"header|expected after 'OFF'"):
        read_off(text)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1_000_000


@pytest.mark.parametrize("prefix", [b"", b"CN"])
def test_binary_is_known_by_its_header(prefix: bytes) -> None:
    numbers = np.zeros((5, 10 if prefix else 3), dtype=">f4")
    numbers[:, :3] = POINTS
    faces = np.concatenate([[len(face), *face, 0] for face in FACES]).astype(">i4")
    data = np.array([5, 5, 0], dtype=">i4").tobytes() + numbers.tobytes() + faces.tobytes()
    for line in (b"OFF BINARY\n", b"OFF BINARY \r\n"):
        mesh = read_off(prefix + line + data)
        assert face_lists(mesh) == FACES
        np.testing.assert_array_equal(mesh.points, POINTS)


@pytest.mark.parametrize("end", ["\n", " "])
def test_faces_and_points_are_counted_against_the_limits(end: str) -> None:
    text = written(end=end).encode()
    assert face_lists(read_off(text, limits=ReadLimits(max_faces=5))) == FACES
    with pytest.raises(ReadError, match=r"prepare\.max_faces"):
        read_off(text, limits=ReadLimits(max_faces=4))
    with pytest.raises(ReadError, match=r"at most 3 points .*prepare\.max_faces"):
        read_off(b"OFF 4 1 0\n" + 4 * b"0 0 1\n" + b"3 0 1 2", limits=ReadLimits(max_faces=1))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("OFF", "expected after 'OFF', found nothing"),
        ("OFF\n5", "expected after 'OFF', found 5"),
        (written(header="OFF\n-5 5 0\n"), "expected after 'OFF', found -5 5"),
        (written(header="OFF\n5.5 5 0\n"), "expected after 'OFF', found 5.5 5"),
        (written(header="OFF\n5 6 0\n"), "declares 5 points with 3 numbers each and 6 faces, which do not fit"),
        (written(header="OFF\n5 4 0\n"), "declares 5 points with 3 numbers each and 4 faces, which do not fit"),
        (written(header="OFF\n30 5 0\n"), "declares 30 points and 5 faces, but only 39 numbers"),
        (written()[:-10], "do not fit"),
        (written(header="OFF BINARY\n5 5 8\n"), "bytes that follow"),
        ("OFF BINARY\n", "expected after 'OFF BINARY', found 0 bytes"),
        (written(header="4OFF\n5 5 8\n"), "4 or n dimensions"),
        (written(header="nOFF\n3\n5 5 8\n"), "4 or n dimensions"),
        (written().replace("1 1 0", "1 1"), "line 5: a point with 3 coordinates was expected, found 2"),
        (written().replace("3 1 2 4", "4 1 2 4"), "line 10: a number of corners and as many"),
        (written().replace("3 1 2 4", "-3 1 2 4"), "line 10: a number of corners and as many"),
        (written().replace("3 1 2 4", "3.5 1 2 4"), "line 10: a number of corners and as many"),
        (written().replace("3 1 2 4", "1e300 1 2 4"), "line 10: a number of corners and as many"),
        (written().replace("3 1 2 4", "3 1 2.5 4"), "face 3 of 5: a point index was expected, found 2.5"),
        (written().replace("3 1 2 4", "3 1 nan 4"), "face 3 of 5: a point index was expected, found nan"),
        (written().replace("3 1 2 4", "3 one 2 4"), "line 10: a number was expected, found 'one'"),
        (written(end=" ").replace("3 1 2 4", "nan 1 2 4"), "do not fit"),
    ],
)
def test_faults_are_named(text: str, message: str) -> None:
    with pytest.raises(ReadError, match=message):
        read_off(text.encode())
