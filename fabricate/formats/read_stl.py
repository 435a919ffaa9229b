"""Reading STL files, binary and text; equal corners of the triangles become one point."""

from __future__ import annotations

import re
from itertools import chain

import numpy as np

from fabricate.arrays import Floats
from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.number_rows import unix_lines
from fabricate.formats.welding import welded
from fabricate.mesh.polygon_mesh import PolygonMesh

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER_BYTES = 84

_FACET = re.compile(
    rb"\bfacet\s+normal\s+\S+\s+\S+\s+\S+\s+outer\s+loop"
    + 3 * rb"\s+vertex\s+(\S+)\s+(\S+)\s+(\S+)"
    + rb"\s+endloop\s+endfacet\b"
)


def read_stl(content: bytes, *, limits: ReadLimits = DEFAULT_LIMITS) -> PolygonMesh:
    """Read the triangles of an STL file; corners with equal coordinates become one point.

    Raises
    ------
    ReadError
        If the file is neither a binary STL of the size that its triangle count asks for, nor text whose
        facets are whole; or has too many of them.
    """
    if is_binary_stl(content):
        limits.check_faces(_triangle_count(content))
        return _welded(_binary_corners(content))
    text = unix_lines(content).lower()
    if re.match(rb"\s*solid\b", text) and re.search(rb"\b(?:facet|endsolid)\b", text):
        return _welded(_text_corners(text, limits))
    raise ReadError(_not_stl(content))


def is_binary_stl(content: bytes) -> bool:
    """Tell whether the size is exactly that of the triangle count in the header, whatever else it says."""
    return len(content) >= _HEADER_BYTES and len(content) == _binary_size(content)


def _binary_size(content: bytes) -> int:
    return _HEADER_BYTES + _TRIANGLE.itemsize * _triangle_count(content)


def _triangle_count(content: bytes) -> int:
    return int.from_bytes(content[80:_HEADER_BYTES], "little")


def _not_stl(content: bytes) -> str:
    if len(content) < _HEADER_BYTES:
        return f"an STL file was expected, but {len(content)} bytes are too few for one and 'facet' is missing"
    return (
        f"the header declares {_triangle_count(content)} triangles, which take {_binary_size(content)} "
        f"bytes, but the file has {len(content)}; it is cut off or not an STL file"
    )


def _binary_corners(content: bytes) -> Floats:
    triangles = np.frombuffer(content, dtype=_TRIANGLE, offset=_HEADER_BYTES)
    with np.errstate(invalid="ignore"):  # signalling NaNs are judged later, like all others
        return triangles["corners"].reshape(-1, 3).astype(np.float64)


def _text_corners(text: bytes, limits: ReadLimits) -> Floats:
    text = re.sub(rb"(?m)^[^\S\n]*(?:end)?solid\b[^\n]*", b"", text)  # a solid's name may hold any words
    count = sum(1 for _ in re.finditer(rb"\bfacet\b", text))
    limits.check_faces(count)
    if count != sum(1 for _ in _FACET.finditer(text)):
        raise ReadError(_broken_facet(text))
    words = chain.from_iterable(map(re.Match.groups, _FACET.finditer(text)))
    try:
        return np.fromiter(map(float, words), dtype=np.float64, count=9 * count).reshape(-1, 3)
    except ValueError:
        raise ReadError(_wrong_number(text)) from None


def _broken_facet(text: bytes) -> str:
    whole = {facet.start() for facet in _FACET.finditer(text)}
    broken = next(begin.start() for begin in re.finditer(rb"\bfacet\b", text) if begin.start() not in whole)
    return (
        f"line {_line(text, broken)}: a facet with a normal and one loop of 3 vertices was expected; "
        "the file is cut off or damaged here"
    )


def _wrong_number(text: bytes) -> str:
    for facet in _FACET.finditer(text):
        try:
            list(map(float, facet.groups()))
        except ValueError:
            return f"line {_line(text, facet.start())}: the facet has a coordinate that is not a number"
    return "a coordinate is not a number"


def _line(text: bytes, place: int) -> int:
    return text.count(b"\n", 0, place) + 1


def _welded(corners: Floats) -> PolygonMesh:
    count = len(corners)
    return welded(PolygonMesh(corners, np.arange(count), np.arange(0, count + 1, 3)))
