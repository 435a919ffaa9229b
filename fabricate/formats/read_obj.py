"""Reading Wavefront OBJ files: points and polygons, nothing else."""

from __future__ import annotations

import re

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.number_rows import NumberRows, number_rows, unix_lines, whole
from fabricate.mesh.polygon_mesh import PolygonMesh


def read_obj(content: bytes, *, limits: ReadLimits = DEFAULT_LIMITS) -> PolygonMesh:
    """Read the `v` and `f` statements of an OBJ file, with polygons of any size.

    Texture and normal indices, weights and colours of points, groups and materials are passed over.

    Raises
    ------
    ReadError
        If there are no faces or too many, or a point or face cannot be read; then the message gives the line.
    """
    text = _logical_lines(content)
    limits.check_faces(_count(text, b"f"))
    limits.check_points(_count(text, b"v"))
    points = number_rows(_statements(text, b"v"), limits=limits)
    faces = number_rows(re.sub(rb"/\S*", b"", _statements(text, b"f")), limits=limits)
    _check_sizes(text, points, faces)
    return PolygonMesh(points.values[points.offsets[:-1, None] + np.arange(3)], _corners(points, faces), faces.offsets)


def _logical_lines(content: bytes) -> bytes:
    """Return the text without comments and with continued lines joined; lines keep their numbers."""
    text = re.sub(rb"#[^\n]*", b"", unix_lines(content))
    if b"\\\n" not in text:
        return text
    return re.sub(rb"(?m)^(?:[^\n]*\\\n)+[^\n]*", _joined, text)


def _joined(lines: re.Match[bytes]) -> bytes:
    return lines[0].replace(b"\\\n", b" ") + b"\n" * lines[0].count(b"\\\n")


def _count(text: bytes, keyword: bytes) -> int:
    return sum(1 for _ in re.finditer(rb"(?m)^[^\S\n]*" + keyword + rb"(?!\S)", text))


def _statements(text: bytes, keyword: bytes) -> bytes:
    """Return the arguments of one kind of statement, each on its line, and all other lines empty."""
    return re.sub(rb"(?m)^[^\S\n]*(?:" + keyword + rb"(?!\S)|[^\n]*)", b"", text)


def _check_sizes(text: bytes, points: NumberRows, faces: NumberRows) -> None:
    bare = re.search(rb"(?m)^[^\S\n]*[vf][^\S\n]*$", text)
    if bare is not None:
        line = text.count(b"\n", 0, bare.end()) + 1
        raise ReadError(f"line {line}: numbers were expected after '{bare[0].strip().decode()}', found none")
    if not len(faces.lines):
        strokes = _count(text, b"l")
        raise ReadError(f"faces ('f') were expected, found only {len(points.lines)} points and {strokes} lines")
    for rows, name in ((points, "a point with 3 coordinates"), (faces, "a face with at least 3 corners")):
        if (rows.sizes < 3).any():
            short = np.argmax(rows.sizes < 3)
            raise ReadError(f"line {rows.lines[short]}: {name} was expected, found {rows.sizes[short]} numbers")


def _corners(points: NumberRows, faces: NumberRows) -> Indices:
    """Return 0-based point indices; the file counts from 1, and back from the face if negative."""
    indices: Floats = faces.values
    lines = np.repeat(faces.lines, faces.sizes)
    points_before = np.searchsorted(points.lines, lines)
    in_range = (indices >= -points_before) & (indices <= len(points.lines)) & (indices != 0)
    usable = in_range & whole(indices)
    if not usable.all():
        wrong = np.argmin(usable)
        raise ReadError(
            f"line {lines[wrong]}: the face refers to point {indices[wrong]:.15g}, but the points are "
            f"numbered 1 to {len(points.lines)}, or -1 to -{points_before[wrong]} counting back from here"
        )
    return np.where(indices < 0, points_before + indices, indices - 1).astype(np.int64)
