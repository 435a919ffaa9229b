"""OBJ: polygons come back as written, whatever the spelling, and every fault is given with its line."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.errors import ReadError
from fabricate.formats.read_obj import read_obj
from fabricate.mesh.polygon_mesh import PolygonMesh

PYRAMID = """v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0.5 0.5 1e0
f 4 3 2 1
f 1 2 5
f 2 3 5
f 3 4 5
f 4 1 5
"""
PYRAMID_FACES = [[3, 2, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]


def face_lists(mesh: PolygonMesh) -> list[list[int]]:
    return [part.tolist() for part in np.split(mesh.corners, mesh.offsets[1:-1])]


def assert_pyramid(text: str) -> None:
    mesh = read_obj(text.encode())
    assert face_lists(mesh) == PYRAMID_FACES
    np.testing.assert_array_equal(mesh.points, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]])


def test_quads_and_triangles_are_kept() -> None:
    assert_pyramid(PYRAMID)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("\n", "\r\n"),
        ("\n", "\r"),
        ("\n", " \t\n\n"),
        ("\n", " # f 1 2 3 \\\n"),
        ("v ", "\t v\t"),
        ("f 4 3", "f 4 \\\n3"),
        ("f 4 3 2 1", "f 4 \\\n 3 \\\n 2 \\\n 1"),
        ("f 1 2 5", "f 1/7/1 2/8/1 5/9/1"),
        ("f 1 2 5", "f 1//3 2//3 5//3"),
        ("f 1 2 5", "f 1/4 2/5 5/6"),
        ("f 1 2 5", "f 1/ 2// 5"),
        ("f 1 2 5", "f -5 -4 -1"),
        ("f 1 2 5", "f -5/-1/-1 2 -1/2"),
        ("v 1 1 0", "v 1 1 0 1.0"),
        ("v 1 1 0", "v 1 1 0 0.7 0.8 0.9"),
        (
            "f 4 3 2 1",
            "mtllib x.mtl\no cube\ng side f 1\nusemtl v\ns off\nvn 0 0 1\nvt 0 0\nvp 1 1\nf 4 3 2 1",
        ),
        ("f 4 3 2 1", "l 1 2\np 1\nfo 1 2 3\nf 4 3 2 1"),
        ("v 0 0 0", "# ünïcödé \udce9"[:-1] + "\nv 0 0 0"),
    ],
)
def test_other_spellings_are_the_same_pyramid(old: str, new: str) -> None:
    assert_pyramid(PYRAMID.replace(old, new))


def test_last_line_needs_no_end() -> None:
    assert_pyramid(PYRAMID.rstrip())


@given(st.data())
def test_any_polygons_in_any_order_come_back(data: st.DataObject) -> None:
    number = data.draw(st.integers(3, 9))
    coordinates = st.tuples(*3 * [st.floats(-1e6, 1e6)])
    points = data.draw(st.lists(coordinates, min_size=number, max_size=number))
    sizes = st.lists(st.integers(0, number - 1), min_size=3, max_size=number)
    faces = data.draw(st.lists(sizes, min_size=1, max_size=6))
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points]
    for face in faces:
        place = data.draw(st.integers(0, len(lines)))
        before = sum(line.startswith("v") for line in lines[:place])
        counted_back = [data.draw(st.booleans()) and corner < before for corner in face]
        words = [str(corner - before if back else corner + 1) for corner, back in zip(face, counted_back, strict=True)]
        lines.insert(place, "f " + " ".join(words))
    mesh = read_obj("\n".join(lines).encode())
    np.testing.assert_array_equal(mesh.points, points)
    assert sorted(face_lists(mesh)) == sorted(faces)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("v 1 1 0", "v 1 1", "line 3: a point with 3 coordinates was expected, found 2"),
        ("v 1 1 0", "v", "line 3: numbers were expected after 'v', found none"),
        ("v 1 1 0", "v 1,0 1 0", "line 3: a number was expected, found '1,0'"),
        ("v 1 1 0", "v 1 \\\n 1 x", "line 3: a number was expected, found 'x'"),
        ("f 1 2 5", "f 1 2", "line 7: a face with at least 3 corners was expected, found 2"),
        ("f 1 2 5", "  f  ", "line 7: numbers were expected after 'f', found none"),
        ("f 1 2 5", "f 1 2 five", "line 7: a number was expected, found 'five'"),
        ("f 1 2 5", "f 1 2 /5", "line 7: a face with at least 3"),
        ("f 1 2 5", "f 1 2 6", "line 7: the face refers to point 6, but the points are numbered 1 to 5"),
        ("f 1 2 5", "f 0 1 2", "line 7: the face refers to point 0"),
        ("f 1 2 5", "f 1 2 -6", "line 7: the face refers to point -6.*-1 to -5"),
        ("f 1 2 5", "f 1 2 2.5", "line 7: the face refers to point 2.5"),
        ("f 1 2 5", "f 1 2 99999999999999999999", "line 7: the face refers to point 1e"),
        ("f 1 2 5", "f 1 2 nan", "line 7: the face refers to point nan"),
        ("v 0 0 0", "# a \\\nv 0 0 \\\n0\nf -1 -1 -2", "line 4: the face refers to point -2.*-1 to -1"),
    ],
)
def test_faults_are_given_with_their_line(old: str, new: str, message: str) -> None:
    with pytest.raises(ReadError, match=message):
        read_obj(PYRAMID.replace(old, new).encode())


def test_continued_lines_do_not_shift_the_numbers_of_later_ones() -> None:
    text = PYRAMID.replace("f 4 3", "f 4 \\\n3").replace("f 4 1 5", "f 4 1 9")
    with pytest.raises(ReadError, match="line 11: "):
        read_obj(text.encode())


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("v 0 0 0\nv 1 0 0\nl 1 2\n", "only 2 points and 1 lines"),
        ("v 0 0 0\np 1", "only 1 points and 0 lines"),
        ("nothing here", "only 0 points and 0 lines"),
    ],
)
def test_file_without_faces_says_what_is_there(text: str, found: str) -> None:
    with pytest.raises(ReadError, match=found):
        read_obj(text.encode())


def test_binary_rubbish_is_refused() -> None:
    with pytest.raises(ReadError):
        read_obj(np.random.default_rng(0).bytes(5000))
