"""Reading a polygon mesh from a file: finding out what it is, and refusing what cannot be used."""

from __future__ import annotations

import codecs
import re
from pathlib import Path
from typing import Protocol

import numpy as np

from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.point_values import PointValues
from fabricate.formats.read_3mf import read_3mf
from fabricate.formats.read_glb import read_glb
from fabricate.formats.read_glb_document import GLB_MAGIC
from fabricate.formats.read_obj import read_obj
from fabricate.formats.read_off import OFF_HEADER, read_off
from fabricate.formats.read_ply import read_ply, read_ply_attribute
from fabricate.formats.read_stl import is_binary_stl, read_stl
from fabricate.mesh.closed import LARGEST_COORDINATE
from fabricate.mesh.polygon_mesh import PolygonMesh


class _Reader(Protocol):
    def __call__(self, content: bytes, *, limits: ReadLimits) -> PolygonMesh: ...


_READERS: dict[str, _Reader] = {
    ".3mf": read_3mf, ".glb": read_glb, ".obj": read_obj, ".off": read_off, ".ply": read_ply, ".stl": read_stl,
}  # fmt: skip
_MAGICS: tuple[tuple[bytes, _Reader], ...] = ((b"PK\x03\x04", read_3mf), (GLB_MAGIC, read_glb))

_ENCODINGS = (  # UTF-32 first: its mark begins with that of UTF-16
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
    (codecs.BOM_UTF8, "utf-8-sig"),
)

_SNIFFED_BYTES = 1 << 16
"""Kinds of text are told apart by their first statements; licences and comments before them are shorter."""


def read_mesh(path: Path, *, limits: ReadLimits = DEFAULT_LIMITS) -> PolygonMesh:
    """Read a 3MF, GLB, OBJ, OFF, PLY or STL file, keeping polygons as they are.

    What the file holds decides how it is read; its name only counts when the contents leave it open.
    Points that no face uses are dropped. Only points at equal places in GLB and STL files become one.

    Parameters
    ----------
    path : Path
        The file.
    limits : ReadLimits
        How large it may be; files that are larger are refused before that costs memory.

    Returns
    -------
    PolygonMesh
        In the file's own unit; not known to be closed (see `checked_closed`).

    Raises
    ------
    ReadError
        If the file is missing, of another kind, too large, damaged, without faces, or holds numbers that cannot
        be used. The message begins with the path.
    """
    try:
        content = _as_utf8(_content(path, limits))
        return _usable(_reader(content, path.suffix)(content, limits=limits))
    except ReadError as error:
        raise ReadError(f"{path}: {error}") from None


def read_attribute(path: Path, name: str, *, limits: ReadLimits = DEFAULT_LIMITS) -> PointValues:
    """Read a PLY file, polygons kept, and the number of that name which it has for every point.

    Raises
    ------
    ReadError
        If the file is missing, no PLY file, too large or damaged, or its points have no such number, or one that is
        not finite. The message begins with the path.
    """
    try:
        content = _as_utf8(_content(path, limits))
        if _reader(content, path.suffix) is not read_ply:
            raise ReadError(f"the attribute '{name}' was expected in it, but only PLY files have attributes")
        found = read_ply_attribute(content, name, limits=limits)
        _check_faces(found.mesh)
        wrong = int(np.count_nonzero(~np.isfinite(found.values)))
        if wrong:
            raise ReadError(f"the attribute '{name}' was expected to be a number, but is none at {wrong} points")
    except ReadError as error:
        raise ReadError(f"{path}: {error}") from None
    return found


def _content(path: Path, limits: ReadLimits) -> bytes:
    try:
        if path.exists() and not path.is_file():  # a device or pipe might never end
            raise ReadError(f"a mesh file was expected, found a {'folder' if path.is_dir() else 'device'}")
        limits.check_bytes(path.stat().st_size)
        content = path.read_bytes()
    except FileNotFoundError:
        raise ReadError("there is no such file") from None
    except OSError as error:
        raise ReadError(f"the file cannot be read ({error.strerror})") from None
    if not content.strip():
        raise ReadError("the file is empty")
    return content


def _as_utf8(content: bytes) -> bytes:
    """Return text in UTF-16 or UTF-32 as UTF-8 without a byte order mark, and anything else as it is."""
    is_binary = is_binary_stl(content) or any(content.startswith(magic) for magic, _ in _MAGICS)
    encoding = None if is_binary else _encoding(content)
    if encoding is None:
        return content
    try:
        return content.decode(encoding).encode()
    except UnicodeError:
        raise ReadError(f"the file begins as {encoding} text, but goes on as something else") from None


def _encoding(content: bytes) -> str | None:
    for mark, encoding in _ENCODINGS:
        if content.startswith(mark):
            return encoding
    evens, odds = content[0:64:2], content[1:64:2]
    if len(odds) < 4:
        return None
    if not any(odds) and all(evens):
        return "utf-16-le"
    if not any(evens) and all(odds):
        return "utf-16-be"
    return None


def _reader(content: bytes, suffix: str) -> _Reader:
    head = re.sub(rb"#[^\r\n]*", b"", content[:_SNIFFED_BYTES])
    if is_binary_stl(content) or re.match(rb"(?i)\s*solid\b", head):
        return read_stl
    for magic, reader in _MAGICS:
        if content.startswith(magic):
            return reader
    if re.match(rb"ply[ \t]*[\r\n]", content):
        return read_ply
    if OFF_HEADER.match(head):
        return read_off
    if b"\0" not in head and re.search(rb"(?:\A|[\r\n])[ \t]*[vf][ \t]+[-+.0-9]", head):
        return read_obj
    if suffix.lower() in _READERS:
        return _READERS[suffix.lower()]
    kind = f"a file named '{suffix}'" if suffix else "a file without an extension"
    raise ReadError(
        f"a 3MF, GLB, OBJ, OFF, PLY or STL mesh was expected, found {kind} whose contents are none of these"
    )


def _usable(mesh: PolygonMesh) -> PolygonMesh:
    """Return the mesh without points that no face uses, if all its numbers can be used."""
    _check_faces(mesh)
    used = np.zeros(len(mesh.points), dtype=bool)
    used[mesh.corners] = True
    unusable = used & ~(np.abs(mesh.points) <= LARGEST_COORDINATE).all(axis=1)
    if unusable.any():
        point = int(np.argmax(unusable))
        found = ", ".join(f"{value:.6g}" for value in mesh.points[point])
        raise ReadError(
            f"{unusable.sum()} of {len(used)} points cannot be used: coordinates of finite size, at most "
            f"{LARGEST_COORDINATE:g}, were expected, found ({found}) for point {point + 1} counted from 1"
        )
    return PolygonMesh(mesh.points[used], (np.cumsum(used) - 1)[mesh.corners], mesh.offsets)


def _check_faces(mesh: PolygonMesh) -> None:
    count = len(mesh.offsets) - 1
    if not count:
        raise ReadError(f"faces were expected, found none and {len(mesh.points)} points")
    if (mesh.face_sizes < 3).any():
        face = int(np.argmax(mesh.face_sizes < 3))
        raise ReadError(
            f"face {face + 1} of {count} was expected to have at least 3 corners, found {mesh.face_sizes[face]}"
        )
    outside = (mesh.corners < 0) | (mesh.corners >= len(mesh.points))
    if outside.any():
        corner = int(np.argmax(outside))
        raise ReadError(
            f"face {mesh.face_of_corner[corner] + 1} of {count} refers to point {mesh.corners[corner]}, "
            f"but the {len(mesh.points)} points are numbered from 0"
        )
