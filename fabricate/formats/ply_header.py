"""The header of a PLY file: the elements and properties that it declares, and where the data begin."""

from __future__ import annotations

import re
from dataclasses import dataclass

from fabricate.errors import ReadError
from fabricate.formats.number_rows import quoted

_KINDS = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
    "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
    "float32": "f4", "float64": "f8",
}  # fmt: skip
_LONGEST_HEADER = 1 << 16
_BYTE_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}


@dataclass(frozen=True)
class PlyProperty:
    """One property: its number kind, and that of its length if it is a list (numpy codes as `f4`)."""

    name: str
    kind: str
    length_kind: str | None


@dataclass(frozen=True)
class PlyElement:
    """One kind of row, and how many of them follow each other."""

    name: str
    count: int
    properties: tuple[PlyProperty, ...]


@dataclass(frozen=True)
class PlyHeader:
    """What the header declares; `byte_order` is empty for text, `begin` is where the data begin."""

    byte_order: str
    elements: tuple[PlyElement, ...]
    begin: int

    @property
    def summary(self) -> str:
        """Words for a message: how many rows of which elements there are to be."""
        return ", ".join(f"{element.count} {element.name}" for element in self.elements) or "nothing"


def read_ply_header(content: bytes) -> PlyHeader:
    """Read the header at the beginning of a PLY file; its lines may end in any one way.

    Raises
    ------
    ReadError
        If it does not begin or end, or a format, element or property in it is unknown; gives the line.
    """
    first = re.match(rb"ply[ \t]*(\r\n|\n|\r)", content)
    if first is None:
        raise ReadError(f"a PLY file was expected to begin with a line 'ply', found {quoted(content[:12])}")
    last = re.search(rb"(?<=[\r\n])end_header[ \t]*(?:" + first[1] + rb"|\Z)", content[:_LONGEST_HEADER])
    if last is None:
        raise ReadError(
            f"the PLY header was expected to end with a line 'end_header' within {_LONGEST_HEADER} bytes, found none"
        )
    lines = content[: last.start()].decode("utf-8", errors="replace").split(first[1].decode())
    statements = [(number, line.split()) for number, line in enumerate(lines, start=1)]
    return PlyHeader(_byte_order(statements), _elements(statements), last.end())


def _byte_order(statements: list[tuple[int, list[str]]]) -> str:
    for number, words in statements:
        if words[:1] == ["format"]:
            if len(words) < 2 or words[1] not in _BYTE_ORDERS:
                raise ReadError(f"line {number}: the format was expected to be one of {', '.join(_BYTE_ORDERS)}")
            return _BYTE_ORDERS[words[1]]
    raise ReadError("the PLY header was expected to have a line 'format', found none")


def _elements(statements: list[tuple[int, list[str]]]) -> tuple[PlyElement, ...]:
    elements: list[PlyElement] = []
    for number, words in statements:
        match words:
            case ["element", name, count] if re.fullmatch(r"[0-9]{1,18}", count):
                elements.append(PlyElement(name, int(count), ()))
            case ["property", "list", length_kind, kind, name] if elements and _is_length(length_kind):
                elements[-1] = _extended(elements[-1], name, kind, length_kind, number)
            case ["property", kind, name] if elements:
                elements[-1] = _extended(elements[-1], name, kind, None, number)
            case ["element" | "property", *_]:
                raise ReadError(f"line {number}: {quoted(' '.join(words).encode())} cannot be understood")
    return tuple(elements)


def _is_length(kind: str) -> bool:
    return _KINDS.get(kind, "f")[0] in "iu"


def _extended(element: PlyElement, name: str, kind: str, length_kind: str | None, line: int) -> PlyElement:
    if kind not in _KINDS:
        known = ", ".join(_KINDS)
        raise ReadError(f"line {line}: a property type was expected ({known}), found {quoted(kind.encode())}")
    declared = PlyProperty(name, _KINDS[kind], None if length_kind is None else _KINDS[length_kind])
    return PlyElement(element.name, element.count, (*element.properties, declared))
