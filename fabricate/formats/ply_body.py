"""The data of a PLY file, as text or as bytes: where the rows and properties that a header declares are."""

from __future__ import annotations

import struct
from collections.abc import Container
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from fabricate.arrays import Floats, Indices
from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.number_rows import NumberRows, number_rows, unix_lines, whole
from fabricate.formats.ply_header import PlyElement, PlyHeader, PlyProperty


@dataclass(frozen=True, eq=False)
class PlyColumn:
    """Where one property is in each of r rows.

    Attributes
    ----------
    declared : PlyProperty
        The property.
    firsts : (r,) int
        The place of its first number.
    lengths : (r,) int
        How many numbers there are: 1, or those in a list.
    """

    declared: PlyProperty
    firsts: Indices
    lengths: Indices


class PlyBody(Protocol):
    """The data after the header; a place in it counts numbers in text and bytes in binary files."""

    @property
    def begin(self) -> int:
        """The first place."""

    @property
    def end(self) -> int:
        """The place after the last number."""

    def size(self, kind: str) -> int:
        """Return how many places a number takes."""

    def read(self, places: Indices, kind: str) -> Floats:
        """Return the numbers that begin at these places."""

    def bounds(self, element: PlyElement, begin: int) -> Indices:
        """Return the (count + 1,) places where the rows of an element begin and the last one ends."""

    def where(self, place: int) -> str:
        """Return words for a message that lead to a place."""

    def left_over(self, place: int) -> str:
        """Return words for what follows a place, none if that is only white space."""


def ply_body(content: bytes, header: PlyHeader, *, limits: ReadLimits = DEFAULT_LIMITS) -> PlyBody:
    """Return the data that follow a header in the content of a file.

    Raises
    ------
    ReadError
        If the data are text, and a word in it is not a number or there are too many of them.
    """
    if header.byte_order:
        return _BinaryBody(content, header.begin, header.byte_order, limits)
    first_line = unix_lines(content[: header.begin]).count(b"\n") + 1
    rows = number_rows(unix_lines(content[header.begin :]), first_line=first_line, limits=limits)
    return _TextBody(rows, limits)


def ply_columns(
    body: PlyBody, element: PlyElement, begins: Indices, names: Container[str]
) -> tuple[list[PlyColumn], Indices]:
    """Return where properties of rows that begin at given places are, and the place where each row ends.

    Only properties that have one of the names come back.

    Raises
    ------
    ReadError
        If a list has no length, or a row does not end within the data; the message gives the place.
    """
    columns, at = [], begins
    for declared in element.properties:
        lengths: Indices = np.broadcast_to(np.int64(1), len(begins))  # takes no memory
        if declared.length_kind is not None:
            lengths = _lengths(body, element, at, declared.length_kind)
            at = at + body.size(declared.length_kind)
        if declared.name in names:
            columns.append(PlyColumn(declared, at, lengths))
        at = at + lengths * body.size(declared.kind)
    past = np.flatnonzero(at > body.end)
    if len(past):
        raise ReadError(f"{body.where(int(begins[past[0]]))}: the file ends inside a row of '{element.name}'")
    return columns, at


@dataclass(frozen=True, eq=False)
class _TextBody:
    """Numbers as text, one row per line."""

    rows: NumberRows
    limits: ReadLimits
    begin: int = 0

    @property
    def end(self) -> int:
        return len(self.rows.values)

    def size(self, kind: str) -> int:  # noqa: ARG002
        return 1

    def read(self, places: Indices, kind: str) -> Floats:  # noqa: ARG002
        return self.rows.values[places]

    def bounds(self, element: PlyElement, begin: int) -> Indices:
        first = int(np.searchsorted(self.rows.offsets, begin))
        left = len(self.rows.lines) - first
        if element.count > left:
            raise ReadError(_too_few(element, f"{left} lines"))
        _check_count(element, self.limits)
        return self.rows.offsets[first : first + element.count + 1]

    def where(self, place: int) -> str:
        row = np.searchsorted(self.rows.offsets, place, side="right") - 1
        return f"line {self.rows.lines[row]}"

    def left_over(self, place: int) -> str:
        return f"{self.end - place} numbers" if place < self.end else ""


@dataclass(frozen=True, eq=False)
class _BinaryBody:
    """Numbers as bytes, without anything between them."""

    content: bytes
    begin: int
    byte_order: str
    limits: ReadLimits

    @property
    def end(self) -> int:
        return len(self.content)

    def size(self, kind: str) -> int:
        return np.dtype(kind).itemsize

    def read(self, places: Indices, kind: str) -> Floats:
        every = max(len(self.content) - self.size(kind) + 1, 0)
        at_every_byte: NDArray[Any] = np.ndarray(every, dtype=self.byte_order + kind, buffer=self.content, strides=(1,))
        with np.errstate(invalid="ignore"):  # signalling NaNs are judged later, like all others
            return at_every_byte[places].astype(np.float64)

    def bounds(self, element: PlyElement, begin: int) -> Indices:
        width = sum(self.size(declared.length_kind or declared.kind) for declared in element.properties)
        if element.count * width > self.end - begin:
            raise ReadError(_too_few(element, f"{self.end - begin} bytes"))
        _check_count(element, self.limits)
        if element.count and any(declared.length_kind for declared in element.properties):
            return self._list_bounds(element, begin)
        return begin + width * np.arange(element.count + 1)

    def where(self, place: int) -> str:
        return f"byte {place}"

    def left_over(self, place: int) -> str:
        rest = self.content[place:].strip(b"\0\t\r\n ")
        return f"{len(rest)} bytes" if rest else ""

    def _list_bounds(self, element: PlyElement, begin: int) -> Indices:
        """Return where rows with lists begin, at once if every row has lists as long as the first row's."""
        lists = [declared.name for declared in element.properties if declared.length_kind]
        columns, ends = ply_columns(self, element, np.array([begin]), lists)
        bounds = begin + int(ends[0] - begin) * np.arange(element.count + 1)
        if bounds[-1] > self.end:
            return self._walked_bounds(element, begin)
        for column in columns:
            kind = column.declared.length_kind
            places = bounds[:-1] + (column.firsts[0] - begin)
            if kind and (self.read(places - self.size(kind), kind) != column.lengths[0]).any():
                return self._walked_bounds(element, begin)
        return bounds

    def _walked_bounds(self, element: PlyElement, begin: int) -> Indices:
        """Return where rows begin if lists differ in length: known only once the row before is read."""
        steps = [(self._length_reader(declared), self.size(declared.kind)) for declared in element.properties]
        bounds, at = [begin], begin
        for row in range(element.count):
            for length, size in steps:
                if length is None:
                    at += size
                    continue
                if at + length.size > self.end:
                    raise ReadError(_too_few(element, f"data for {row} of them"))
                items = length.unpack_from(self.content, at)[0]
                if items < 0:
                    raise ReadError(_no_length(self, element, at))
                at += length.size + items * size
            bounds.append(at)
        if at > self.end:
            raise ReadError(_too_few(element, f"{self.end - begin} bytes"))
        return np.array(bounds)

    def _length_reader(self, declared: PlyProperty) -> struct.Struct | None:
        if declared.length_kind is None:
            return None
        return struct.Struct(self.byte_order + np.dtype(declared.length_kind).char)


def _check_count(element: PlyElement, limits: ReadLimits) -> None:
    if element.name == "face":
        limits.check_faces(element.count)
    else:  # edges, strips and whatever else: no more of them than of points
        limits.check_points(element.count)


def _too_few(element: PlyElement, left: str) -> str:
    return (
        f"the header declares {element.count} rows of element '{element.name}', but only {left} are left for "
        "them; the file is cut off or its header is wrong"
    )


def _no_length(body: PlyBody, element: PlyElement, place: int) -> str:
    return f"{body.where(place)}: the length of a list of '{element.name}' was expected there"


def _lengths(body: PlyBody, element: PlyElement, places: Indices, kind: str) -> Indices:
    inside = places + body.size(kind) <= body.end
    lengths = body.read(places[inside], kind)
    fits = np.zeros(len(places), dtype=bool)
    fits[inside] = whole(lengths) & (lengths >= 0) & (lengths <= body.end)
    if not fits.all():
        raise ReadError(_no_length(body, element, int(places[np.argmin(fits)])))
    return lengths.astype(np.int64)
