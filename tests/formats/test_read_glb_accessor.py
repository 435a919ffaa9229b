"""Accessors: every number type and stride gives the same numbers, and nothing outside the data is read."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mesh_bytes import accessor

from fabricate.errors import ReadError
from fabricate.formats.read_glb_accessor import read_indices, read_points
from fabricate.formats.read_glb_document import Document, Glb

POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 2, 0], [0, 1, 3]])
CODES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}


def stored(described: dict[str, Any], data: bytes, *, view: dict[str, Any] | None = None, **buffer: Any) -> Glb:
    return Glb(
        Document.model_validate(
            {
                "asset": {"version": "2.0"},
                "accessors": [described],
                "bufferViews": [{"buffer": 0, "byteLength": len(data), **(view or {})}],
                "buffers": [buffer],
            }
        ),
        data,
    )


@pytest.mark.parametrize("code", CODES)
def test_points_of_every_type_are_read(code: int) -> None:
    data = POINTS.astype(CODES[code]).tobytes()
    points = read_points(stored(accessor(0, 4, code, "VEC3"), data), 0)
    assert points.dtype == np.float64
    np.testing.assert_array_equal(points, POINTS)


@pytest.mark.parametrize(("code", "largest"), [(5120, 127), (5121, 255), (5122, 32767), (5123, 65535)])
def test_normalised_integers_are_fractions(code: int, largest: int) -> None:
    values = [[0, largest, 1 if code % 2 else -largest - 1]]
    data = np.array(values).astype(CODES[code]).tobytes()
    points = read_points(stored(accessor(0, 1, code, "VEC3", normalized=True), data), 0)
    np.testing.assert_allclose(points, [[0, 1, 1 / largest if code % 2 else -1]])


@given(st.integers(0, 9), st.integers(0, 9), st.integers(12, 30), st.binary(min_size=300, max_size=300))
def test_strides_and_offsets_lead_to_the_bytes_that_they_say(view: int, inner: int, stride: int, data: bytes) -> None:
    described = accessor(0, 5, 5126, "VEC3", byteOffset=inner)
    where = {"byteOffset": view, "byteLength": inner + 4 * stride + 12, "byteStride": stride}
    points = read_points(stored(described, data, view=where), 0)
    for row, point in enumerate(points):
        begin = view + inner + row * stride
        with np.errstate(invalid="ignore"):  # any four bytes are a float, signalling NaNs among them
            np.testing.assert_array_equal(point, np.frombuffer(data[begin : begin + 12], "<f4").astype(float))


@pytest.mark.parametrize("code", [5121, 5123, 5125])
def test_indices_of_every_type_are_read_and_held_against_the_points(code: int) -> None:
    indices = np.array([0, 2, 1, 3])
    described = stored(accessor(0, 4, code, "SCALAR"), indices.astype(CODES[code]).tobytes())
    assert read_indices(described, 0, points=4).tolist() == indices.tolist()
    with pytest.raises(ReadError, match="accessor 0 refers to point 3, but the 3 points"):
        read_indices(described, 0, points=3)


def test_no_numbers_are_none() -> None:
    assert read_points(stored(accessor(0, 0, 5126, "VEC3", byteOffset=99), b""), 0).shape == (0, 3)
    assert read_indices(stored(accessor(0, 0, 5125, "SCALAR"), b""), 0, points=0).tolist() == []


DATA = POINTS.astype("<f4").tobytes()


@pytest.mark.parametrize(
    ("glb", "words"),
    [
        (stored(accessor(0, 4, 5126, "VEC2"), DATA), "expected to hold VEC3 numbers, found 'VEC2'"),
        (stored(accessor(0, 4, 5124, "VEC3"), DATA), "found 'VEC3' of type 5124"),
        (stored(accessor(0, 4, 5126, "VEC3", sparse={"count": 1}), DATA), "sparse"),
        (
            stored({"count": 4, "componentType": 5126, "type": "VEC3"}, DATA),
            "has no data; save the file without compression",
        ),
        (stored(accessor(1, 4, 5126, "VEC3"), DATA), "buffer view 1, but its 1 are numbered"),
        (stored(accessor(0, 4, 5126, "VEC3"), DATA, uri="more.bin"), "in another file"),
        (stored(accessor(0, 4, 5126, "VEC3"), DATA, view={"buffer": 1}), "in another file"),
        (stored(accessor(0, 5, 5126, "VEC3"), DATA), "declares 5 elements of 12 bytes, 12 bytes apart"),
        (stored(accessor(0, 2**31, 5126, "VEC3"), DATA), "declares 2147483648 elements"),
        (stored(accessor(0, 4, 5126, "VEC3", byteOffset=1), DATA), "do not fit the 48 bytes"),
        (stored(accessor(0, 4, 5126, "VEC3"), DATA, view={"byteStride": 8}), "8 bytes apart"),
        (stored(accessor(0, 4, 5126, "VEC3"), DATA, view={"byteStride": 16}), "16 bytes apart"),
        (stored(accessor(0, 4, 5126, "VEC3"), DATA, view={"byteOffset": 1}), "ends at byte 49, .* 48 bytes of data"),
        (stored(accessor(0, 4, 5126, "VEC3"), DATA, view={"byteLength": 49}), "ends at byte 49"),
    ],
)
def test_what_cannot_be_read_says_why(glb: Glb, words: str) -> None:
    with pytest.raises(ReadError, match=words):
        read_points(glb, 0)


def test_point_indices_are_unsigned() -> None:
    with pytest.raises(ReadError, match="unsigned point indices"):
        read_indices(stored(accessor(0, 4, 5126, "SCALAR"), bytes(16)), 0, points=4)
