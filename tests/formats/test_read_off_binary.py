"""Binary OFF: all byte orders and colours give the same polygons, and counts are never believed."""

from __future__ import annotations

import struct
import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.read_off_binary import read_off_binary
from fabricate.mesh.polygon_mesh import PolygonMesh

POINTS = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]]
FACES = [[3, 2, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
TRIANGLES = [[0, 1, 4], [1, 2, 4], [2, 3, 4]]

ORDERS = pytest.mark.parametrize("order", [">", "<"])


def written(
    faces: list[list[int]], *, order: str = ">", more: list[float] | None = None, colours: list[int] | None = None
) -> bytes:
    """Return the data; `more` follows each point, and `colours` many values each face, none at all without it."""
    data = struct.pack(f"{order}3i", len(POINTS), len(faces), 0)
    for point in POINTS:
        data += struct.pack(f"{order}{3 + len(more or [])}f", *point, *(more or []))
    for number, face in enumerate(faces):
        data += struct.pack(f"{order}{1 + len(face)}i", len(face), *face)
        if colours is not None:
            count = colours[number % len(colours)]
            data += struct.pack(f"{order}i{count}f", count, *[0.5] * count)
    return data


def read(data: bytes, *, width: int = 3, limits: ReadLimits = DEFAULT_LIMITS) -> PolygonMesh:
    return read_off_binary(data, width=width, limits=limits)


def assert_faces(mesh: PolygonMesh, faces: list[list[int]]) -> None:
    assert [part.tolist() for part in np.split(mesh.corners, mesh.offsets[1:-1])] == faces
    np.testing.assert_array_equal(mesh.points, POINTS)


@ORDERS
@pytest.mark.parametrize("faces", [FACES, TRIANGLES], ids=["ragged", "even"])
@pytest.mark.parametrize("colours", [None, [0], [4], [0, 3, 4]])
def test_every_way_of_writing_is_the_same_mesh(order: str, faces: list[list[int]], colours: list[int] | None) -> None:
    assert_faces(read(written(faces, order=order, colours=colours)), faces)


@ORDERS
def test_colours_and_normals_of_points_are_passed_over(order: str) -> None:
    data = written(FACES, order=order, more=[0.1, 0.2, 0.3, 1.0, 0, 0, 1], colours=[0])
    assert_faces(read(data, width=10), FACES)


@pytest.mark.parametrize("colours", [[0], [4]])
def test_every_cut_file_is_refused(colours: list[int]) -> None:
    data = written(FACES, colours=colours)
    for length in range(0, len(data), 4):
        with pytest.raises(ReadError, match=r"three counts|cut off"):
            read(data[:length])


@pytest.mark.parametrize("counts", [(2**31 - 1, 1), (1, 2**31 - 1), (-5, 5), (5, -5), (5, 6), (4, 5)])
def test_counts_that_do_not_fit_are_refused_before_memory_is_taken(counts: tuple[int, int]) -> None:
    data = struct.pack(">2i", *counts) + written(FACES, colours=[0])[8:]
    tracemalloc.start()
    with pytest.raises(ReadError, match="do not fit"):
        read(data)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1_000_000


@pytest.mark.parametrize(("limits", "passes"), [(ReadLimits(max_faces=5), True), (ReadLimits(max_faces=4), False)])
def test_faces_are_counted_against_the_limits(limits: ReadLimits, passes: bool) -> None:
    if passes:
        assert_faces(read(written(FACES), limits=limits), FACES)
        return
    with pytest.raises(ReadError, match=r"prepare\.max_faces"):
        read(written(FACES), limits=limits)


@given(
    st.lists(st.lists(st.integers(0, 4), min_size=1, max_size=6), min_size=1, max_size=6), st.sampled_from([[0], [3]])
)
def test_any_polygons_come_back(faces: list[list[int]], colours: list[int]) -> None:
    assert_faces(read(written(faces, colours=colours)), faces)
