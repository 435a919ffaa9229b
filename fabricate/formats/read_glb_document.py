"""The two halves of a GLB file: the glTF 2.0 document that describes a scene, and the numbers it refers to."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, TypeAlias, TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError
from pydantic.alias_generators import to_camel

from fabricate.errors import ReadError

GLB_MAGIC = b"glTF"
_HEADER = struct.Struct("<4sII")
_CHUNK = struct.Struct("<I4s")
_LONGEST_JSON = 1 << 25
_MOST_ENTRIES = 100_000
"""Nodes, meshes and the like, of each kind: each takes a hundred times the memory of its text."""

Index: TypeAlias = Annotated[int, Field(ge=0, le=2**31)]
"""A place in a list, or a number of bytes or entries."""

_Entry = TypeVar("_Entry")
_List: TypeAlias = Annotated[tuple[_Entry, ...], Field(max_length=_MOST_ENTRIES)]
_Vector: TypeAlias = tuple[float, float, float]


class _Record(BaseModel):
    """A JSON object of which only what describes shape is kept."""

    model_config = ConfigDict(frozen=True, extra="ignore", alias_generator=to_camel, allow_inf_nan=False)


class Asset(_Record):
    """Which glTF it is."""

    version: str


class Buffer(_Record):
    """Bytes; those of a GLB file itself have no address."""

    uri: str | None = None


class BufferView(_Record):
    """A part of a buffer, in bytes."""

    buffer: Index
    byte_offset: Index = 0
    byte_length: Index
    byte_stride: Index | None = None


class Accessor(_Record):
    """Numbers in a buffer view: `count` scalars or vectors."""

    buffer_view: Index | None = None
    byte_offset: Index = 0
    component_type: int
    count: Index
    type: str
    normalized: bool = False
    sparse: object = None


class Primitive(_Record):
    """Points, lines or triangles (mode 4 to 6) over the points of one accessor."""

    attributes: dict[str, Index]
    indices: Index | None = None
    mode: int = 4


class Mesh(_Record):
    """Primitives that belong together."""

    primitives: _List[Primitive]


class Node(_Record):
    """A place in the scene, relative to the node above; its matrix is given column after column."""

    children: _List[Index] = ()
    mesh: Index | None = None
    skin: Index | None = None
    matrix: Annotated[tuple[float, ...], Field(min_length=16, max_length=16)] | None = None
    translation: _Vector = (0, 0, 0)
    rotation: tuple[float, float, float, float] = (0, 0, 0, 1)
    scale: _Vector = (1, 1, 1)
    extensions: dict[str, object] = Field(default_factory=dict)


class Scene(_Record):
    """The nodes at the top."""

    nodes: _List[Index] = ()


class Document(_Record):
    """All that a glTF document says about shape."""

    asset: Asset
    scene: Index | None = None
    scenes: _List[Scene] = ()
    nodes: _List[Node] = ()
    meshes: _List[Mesh] = ()
    accessors: _List[Accessor] = ()
    buffer_views: _List[BufferView] = ()
    buffers: _List[Buffer] = ()
    extensions_required: _List[str] = ()


@dataclass(frozen=True)
class Glb:
    """A document and the bytes behind it."""

    document: Document
    binary: bytes


def read_glb_document(content: bytes) -> Glb:
    """Take a GLB file apart.

    Raises
    ------
    ReadError
        If it is cut off, of another version, or its document is no glTF.
    """
    if len(content) < _HEADER.size:
        raise ReadError(f"a GLB header of {_HEADER.size} bytes was expected, found {len(content)} bytes")
    magic, version, length = _HEADER.unpack_from(content)
    if magic != GLB_MAGIC:
        raise ReadError("a GLB file was expected to begin with 'glTF', found other bytes")
    if version != 2:
        raise ReadError(f"a GLB file of version 2 was expected, found version {version}")
    if length > len(content):
        raise ReadError(f"the header declares {length} bytes, but the file has {len(content)}; it is cut off")
    kind, text, end = _chunk(content[:length], _HEADER.size)
    if kind != b"JSON":
        raise ReadError("a GLB file was expected to begin with its JSON chunk, found another")
    if len(text) > _LONGEST_JSON:
        raise ReadError(f"a GLB file with at most {_LONGEST_JSON} bytes of JSON was expected, found {len(text)}")
    kind, binary, _ = _chunk(content[:length], end) if end < length else (b"", b"", end)
    return Glb(_document(text), binary if kind == b"BIN\0" else b"")


def entry(entries: Sequence[_Entry], index: int, name: str) -> _Entry:
    """Return one entry of a list in the document.

    Raises
    ------
    ReadError
        If there is none with that index.
    """
    if index >= len(entries):
        raise ReadError(f"the file refers to {name} {index}, but its {len(entries)} are numbered from 0")
    return entries[index]


def _chunk(content: bytes, begin: int) -> tuple[bytes, bytes, int]:
    """Return kind, data and end of the chunk that begins at a byte."""
    if begin + _CHUNK.size > len(content):
        raise ReadError(f"byte {begin}: a chunk was expected, found the end of the file; it is cut off")
    length, kind = _CHUNK.unpack_from(content, begin)
    begin += _CHUNK.size
    if begin + length > len(content):
        raise ReadError(f"byte {begin}: a chunk of {length} bytes was expected, found {len(content) - begin} bytes")
    return kind, content[begin : begin + length], begin + length


def _document(text: bytes) -> Document:
    try:
        return Document.model_validate_json(text.rstrip(b"\0"))
    except ValidationError as error:
        first = error.errors(include_url=False, include_context=False, include_input=False)[0]
        place = ".".join(map(str, first["loc"])) or "the document"
        raise ReadError(
            f"the glTF document is damaged at {place[:120]}: {' '.join(first['msg'].split())[:200]}"
        ) from None
