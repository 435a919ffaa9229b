"""The data of a binary OFF file: 32-bit integers and floats without anything between them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fabricate.arrays import Floats, Indices
from fabricate.errors import ReadError
from fabricate.formats.limits import ReadLimits
from fabricate.mesh.polygon_mesh import PolygonMesh

_COUNTS = 3  # points, faces, edges
_ITEM_BYTES = 4


def read_off_binary(data: bytes, *, width: int, limits: ReadLimits) -> PolygonMesh:
    """Read what follows the line 'OFF BINARY'.

    Geomview, whose format it is, writes big-endian numbers, and after each face how many colour values follow.
    Other programs write the byte order of their machine, or no number of colour values: the one way of the
    four is taken in which the faces end where the file ends.

    Parameters
    ----------
    data : bytes
        Counts, points and faces.
    width : int
        How many floats each point has; the first three are its coordinates.
    limits : ReadLimits
        How large it may be.

    Raises
    ------
    ReadError
        If the data do not end where their counts say that they do, or there are too many of them.
    """
    for byte_order in (">", "<"):
        points, faces = _counts(data, byte_order)
        if points < 0 or faces < 0 or _COUNTS + width * points + faces > len(data) // _ITEM_BYTES:
            continue
        limits.check_points(points)
        limits.check_faces(faces)
        coordinates = np.frombuffer(data, f"{byte_order}f4", width * points, _COUNTS * _ITEM_BYTES)
        polygons = _polygons(data, byte_order, _COUNTS + width * points, faces, points)
        if polygons is not None:
            return PolygonMesh(_doubles(coordinates.reshape(points, width)[:, :3]), *polygons)
    points, faces = _counts(data, ">")
    raise ReadError(
        f"the header declares {points} points and {faces} faces, which do not fit the {len(data)} bytes that "
        "follow; the file is cut off or its header is wrong"
    )


def _counts(data: bytes, byte_order: str) -> tuple[int, int]:
    if len(data) < _COUNTS * _ITEM_BYTES:
        raise ReadError(
            f"three counts of {_ITEM_BYTES} bytes were expected after 'OFF BINARY', found {len(data)} bytes"
        )
    points, faces = np.frombuffer(data, dtype=f"{byte_order}i4", count=2).tolist()
    return points, faces


def _polygons(data: bytes, byte_order: str, begin: int, faces: int, points: int) -> tuple[Indices, Indices] | None:
    """Return the corners and offsets of the faces if they end where the data end, with colour values or without."""
    integers = np.frombuffer(data, dtype=f"{byte_order}i4", count=len(data) // _ITEM_BYTES).astype(np.int32)
    firsts = _face_firsts(integers, begin, faces, coloured=True)
    if firsts is not None:
        return _corners(integers, firsts)
    firsts = _face_firsts(integers, begin, faces, coloured=False)
    if firsts is None:
        return None
    corners, offsets = _corners(integers, firsts)
    in_range = (corners >= 0) & (corners < points)  # a file that is cut off may end like one without colours
    return (corners, offsets) if in_range.all() else None


def _face_firsts(integers: NDArray[np.int32], begin: int, faces: int, *, coloured: bool) -> Indices | None:
    """Return where the number of corners of each face is, if all faces together end where the data end."""
    step, rest = divmod(len(integers) - begin, max(faces, 1))
    firsts = begin + step * np.arange(faces)
    corners = step - 2 if coloured else step - 1
    even = faces > 0 and not rest and corners > 0 and bool((integers[firsts] == corners).all())
    if even and not (coloured and integers[firsts + step - 1].any()):
        return firsts
    return _walked_firsts(integers, begin, faces, coloured=coloured)


def _walked_firsts(integers: NDArray[np.int32], begin: int, faces: int, *, coloured: bool) -> Indices | None:
    items, firsts, at = integers.data, [], begin
    for _ in range(faces):  # where a face begins is known only once the one before it is read
        firsts.append(at)
        for least in (1, 0) if coloured else (1,):  # corners, colour values
            if at >= len(items) or items[at] < least:
                return None
            at += 1 + items[at]
    return np.array(firsts, dtype=np.int64) if at == len(items) else None


def _corners(integers: NDArray[np.int32], firsts: Indices) -> tuple[Indices, Indices]:
    sizes = integers[firsts].astype(np.int64)
    offsets: Indices = np.concatenate([[0], np.cumsum(sizes)])
    places = np.repeat(firsts + 1 - offsets[:-1], sizes) + np.arange(offsets[-1])
    return integers[places].astype(np.int64), offsets


def _doubles(coordinates: NDArray[np.float32]) -> Floats:
    with np.errstate(invalid="ignore"):  # signalling NaNs are judged later, like all others
        return coordinates.astype(np.float64)
