"""Reading OFF files: points and polygons, whatever the lines are."""

from __future__ import annotations

import re

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.errors import ReadError
from fabricate.mesh.number_rows import NumberRows, number_rows, unix_lines, whole
from fabricate.mesh.polygon_mesh import PolygonMesh

OFF_HEADER = re.compile(rb"\s*(?:ST)?C?N?(?P<dimensions>4?n?)OFF(?=\s|\Z)(?P<binary>[ \t]+BINARY)?")


def read_off(content: bytes) -> PolygonMesh:
    """Read an OFF file, with any polygons; colours, normals and texture coordinates are passed over.

    One point or face per line is expected; a plain OFF file may break its lines anywhere else.

    Raises
    ------
    ReadError
        If the numbers in the file do not add up to what its header declares.
    """
    rows = number_rows(_without_header(re.sub(rb"#[^\n]*", b"", unix_lines(content))))
    points, faces = _declared_counts(rows)
    if len(rows.lines) == 1 + points + faces and 2 <= rows.offsets[1] <= 3:
        return _read_lines(rows, points)
    return _read_stream(rows.values[3:], points, faces)


def _without_header(text: bytes) -> bytes:
    """Return the text with its first word blanked out, so that lines keep their numbers."""
    header = OFF_HEADER.match(text)
    if header is None:
        return text  # the word is optional in the format
    if header["dimensions"]:
        raise ReadError("an OFF file with points in space was expected, found one in 4 or n dimensions")
    if header["binary"]:
        raise ReadError("a binary OFF file cannot be read; save it as text or as binary PLY")
    return re.sub(rb"\S", b" ", header[0]) + text[header.end() :]


def _declared_counts(rows: NumberRows) -> tuple[int, int]:
    """Return the header's numbers of points and faces, if the file is long enough to hold them."""
    counts = rows.values[:2]
    if len(counts) < 2 or not whole(counts).all() or (counts < 0).any():
        found = " ".join(f"{value:g}" for value in counts) or "nothing"
        raise ReadError(f"the numbers of points and faces were expected after 'OFF', found {found}")
    points, faces = int(counts[0]), int(counts[1])
    if 3 * points + faces > len(rows.values):
        raise ReadError(
            f"the header declares {points} points and {faces} faces, but only {len(rows.values)} numbers "
            "are in the file; it is cut off or its header is wrong"
        )
    return points, faces


def _read_lines(rows: NumberRows, points: int) -> PolygonMesh:
    """Read one point or face per line, and pass over what follows on the line."""
    firsts, sizes, lines = rows.offsets[1:-1], rows.sizes[1:], rows.lines[1:]
    wanted = np.where(np.arange(len(firsts)) < points, 3, rows.values[firsts] + 1)
    wrong = np.flatnonzero(~(whole(wanted) & (wanted >= 1) & (wanted <= sizes)))
    if len(wrong):
        kind = "point with 3 coordinates" if wrong[0] < points else "number of corners and as many indices"
        raise ReadError(f"line {lines[wrong[0]]}: a {kind} was expected, found {sizes[wrong[0]]} numbers")
    corners = wanted[points:].astype(np.int64) - 1
    return _mesh(rows.values, firsts[:points], firsts[points:] + 1, corners)


def _read_stream(values: Floats, points: int, faces: int) -> PolygonMesh:
    """Read points and faces whatever the lines are; nothing else may stand between them."""
    numbers, face_firsts, at = values.tolist(), [], 3 * points
    for _ in range(faces):  # where a face begins is known only once the one before it is read
        if at >= len(numbers) or not (numbers[at].is_integer() and 0 <= numbers[at] < len(numbers)):
            break
        face_firsts.append(at)
        at += 1 + int(numbers[at])
    if len(face_firsts) < faces or at != len(values):
        raise ReadError(
            f"the header declares {points} points and {faces} faces, which do not fit the numbers that "
            "follow; one point or face was expected on each line"
        )
    firsts = np.array(face_firsts, dtype=np.int64)
    return _mesh(values, 3 * np.arange(points), firsts + 1, values[firsts].astype(np.int64))


def _mesh(values: Floats, point_firsts: Indices, corner_firsts: Indices, sizes: Indices) -> PolygonMesh:
    """Gather three coordinates from each point's first, and `sizes` indices from each face's first."""
    offsets = np.concatenate([[0], np.cumsum(sizes)])
    corners = values[np.repeat(corner_firsts - offsets[:-1], sizes) + np.arange(offsets[-1])]
    if not whole(corners).all():
        wrong = np.argmin(whole(corners))
        face = np.searchsorted(offsets, wrong, side="right")
        raise ReadError(f"face {face} of {len(sizes)}: a point index was expected, found {corners[wrong]:g}")
    return PolygonMesh(values[point_firsts[:, None] + np.arange(3)], corners.astype(np.int64), offsets)
