"""Reading OFF files: points and polygons, whatever the lines are."""

from __future__ import annotations

import re

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.number_rows import NumberRows, number_rows, unix_lines, whole
from fabricate.formats.read_off_binary import read_off_binary
from fabricate.mesh.polygon_mesh import PolygonMesh

OFF_HEADER = re.compile(
    rb"\s*(?P<prefix>(?:ST)?C?N?)(?P<dimensions>4?n?)(?:OFF|off)(?=\s|\Z)(?P<binary>[ \t]+BINARY[ \t]*\r?(?:\n|\Z))?"
)
_WIDTHS = {"ST": 2, "C": 4, "N": 3}
"""Numbers that a prefix of the header adds to every point."""


def read_off(content: bytes, *, limits: ReadLimits = DEFAULT_LIMITS) -> PolygonMesh:
    """Read an OFF file, with any polygons; colours, normals and texture coordinates are passed over.

    In text, lines may break anywhere, but each face of a file with coloured faces must have its own line.

    Raises
    ------
    ReadError
        If the numbers in the file do not add up to what its header declares, or that is too much.
    """
    header = OFF_HEADER.match(content)
    if header is not None and header["binary"]:
        width = _point_width(header)
        return read_off_binary(content[header.end() :], width=width, limits=limits)
    text = re.sub(rb"#[^\n]*", b"", unix_lines(content))
    header = OFF_HEADER.match(text)
    rows = number_rows(_without_header(text, header), limits=limits)
    width = _point_width(header)
    points, faces = _declared_counts(rows, limits)
    if len(rows.lines) == 1 + points + faces and 2 <= rows.offsets[1] <= 3:
        return _read_lines(rows, points)
    return _read_stream(rows, points, faces, width)


def _without_header(text: bytes, header: re.Match[bytes] | None) -> bytes:
    """Return the text with its first word blanked out, so that lines keep their numbers."""
    if header is None:
        return text  # the word is optional in the format
    return re.sub(rb"\S", b" ", header[0]) + text[header.end() :]


def _point_width(header: re.Match[bytes] | None) -> int:
    """Return how many numbers the header announces for each point."""
    if header is None:
        return 3
    if header["dimensions"]:
        raise ReadError("an OFF file with points in space was expected, found one in 4 or n dimensions")
    return 3 + sum(width for name, width in _WIDTHS.items() if name.encode() in header["prefix"])


def _declared_counts(rows: NumberRows, limits: ReadLimits) -> tuple[int, int]:
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
    limits.check_points(points)
    limits.check_faces(faces)
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


def _read_stream(rows: NumberRows, points: int, faces: int, width: int) -> PolygonMesh:
    """Read points whatever the lines are, and faces that either have a line each or nothing between them."""
    point_firsts = 3 + width * np.arange(points)
    begin = 3 + width * points
    face_firsts = _faces_on_lines(rows, begin, faces)
    if face_firsts is None:
        face_firsts = _faces_to_end(rows.values, begin, faces)
    if face_firsts is None:
        raise ReadError(
            f"the header declares {points} points with {width} numbers each and {faces} faces, which do not fit the "
            "numbers that follow; one point or face was expected on each line"
        )
    return _mesh(rows.values, point_firsts, face_firsts + 1, rows.values[face_firsts].astype(np.int64))


def _faces_on_lines(rows: NumberRows, begin: int, faces: int) -> Indices | None:
    """Return where faces begin if each has a line, on which colours may follow it."""
    row = int(np.searchsorted(rows.offsets, begin))
    if len(rows.lines) - row != faces or rows.offsets[row] != begin:
        return None
    firsts = rows.offsets[row:-1]
    corners = rows.values[firsts]
    fits = whole(corners) & (corners >= 0) & (corners < rows.sizes[row:])
    return firsts if fits.all() else None


def _faces_to_end(values: Floats, begin: int, faces: int) -> Indices | None:
    """Return where faces begin if the numbers from `begin` on are faces and nothing else."""
    if not faces or begin >= len(values):
        return np.zeros(0, dtype=np.int64) if (faces, begin) == (0, len(values)) else None
    step, rest = divmod(len(values) - begin, faces)
    firsts = begin + step * np.arange(faces)
    if not rest and (values[firsts] == step - 1).all():
        return firsts
    return _walked_faces(values, begin, faces)


def _walked_faces(values: Floats, begin: int, faces: int) -> Indices | None:
    sizes = np.where(whole(values) & (values >= 0), values, -1).astype(np.int64).data
    firsts, at = [], begin
    for _ in range(faces):  # where a face begins is known only once the one before it is read
        if at >= len(sizes) or sizes[at] < 0:
            return None
        firsts.append(at)
        at += 1 + sizes[at]
    return np.array(firsts, dtype=np.int64) if at == len(values) else None


def _mesh(values: Floats, point_firsts: Indices, corner_firsts: Indices, sizes: Indices) -> PolygonMesh:
    """Gather three coordinates from each point's first, and `sizes` indices from each face's first."""
    offsets = np.concatenate([[0], np.cumsum(sizes)])
    corners = values[np.repeat(corner_firsts - offsets[:-1], sizes) + np.arange(offsets[-1])]
    if not whole(corners).all():
        wrong = np.argmin(whole(corners))
        face = np.searchsorted(offsets, wrong, side="right")
        raise ReadError(f"face {face} of {len(sizes)}: a point index was expected, found {corners[wrong]:g}")
    return PolygonMesh(values[point_firsts[:, None] + np.arange(3)], corners.astype(np.int64), offsets)
