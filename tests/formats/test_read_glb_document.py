"""GLB files are taken apart at their declared sizes, and documents that are no glTF are refused with the place."""

from __future__ import annotations

import json
import struct
import tracemalloc
from typing import Any

import pytest
from mesh_bytes import FACES, POINTS, glb, glb_bytes

from fabricate.errors import ReadError
from fabricate.formats.read_glb_document import entry, read_glb_document

ASSET = {"asset": {"version": "2.0"}}


def chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack("<I4s", len(data), kind) + data


def whole(*chunks: bytes) -> bytes:
    data = b"".join(chunks)
    return struct.pack("<4sII", b"glTF", 2, 12 + len(data)) + data


def test_what_describes_shape_comes_back() -> None:
    document: dict[str, Any] = {
        **ASSET,
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "matrix": list(range(16)), "name": "n", "extras": {"any": [None]}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 0, "material": 3}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 2.0, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 24, "byteStride": 12}],
        "buffers": [{"byteLength": 24}],
        "extensionsRequired": ["KHR_anything"],
    }
    read = read_glb_document(glb_bytes(document, bytes(24)))
    assert read.binary == bytes(24)
    assert read.document.nodes[0].matrix == tuple(range(16))
    assert read.document.meshes[0].primitives[0].mode == 4
    assert read.document.accessors[0].count == 2
    assert read.document.buffer_views[0].byte_stride == 12
    assert read.document.extensions_required == ("KHR_anything",)


@pytest.mark.parametrize(
    "text", [b'{"asset":{"version":"2.0"}}', b'{"asset":{"version":"2.0"}}\0', b' {"asset":{"version":"2.0"}} ']
)
def test_data_and_other_chunks_may_be_missing_or_more(text: bytes) -> None:
    assert read_glb_document(whole(chunk(b"JSON", text))).binary == b""
    assert read_glb_document(whole(chunk(b"JSON", text), chunk(b"ABCD", b"1234"))).binary == b""
    assert read_glb_document(whole(chunk(b"JSON", text), chunk(b"BIN\0", b"1234"), b"more")).binary == b"1234"
    assert read_glb_document(whole(chunk(b"JSON", text)) + b"after the end").binary == b""


def test_every_cut_file_is_refused() -> None:
    content = glb(POINTS, FACES)
    for length in range(len(content)):
        with pytest.raises(ReadError, match=r"cut off|a GLB header"):
            read_glb_document(content[:length])


def text_of(**more: Any) -> bytes:
    return json.dumps({**ASSET, **more}).encode()


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"glTF", "a GLB header of 12 bytes was expected, found 4"),
        (b"some other bytes", "begin with 'glTF'"),
        (glb_bytes(ASSET, b"", version=1), "version 2 was expected, found version 1"),
        (whole(chunk(b"BIN\0", b"1234")), "begin with its JSON chunk"),
        (whole(struct.pack("<I4s", 2**32 - 1, b"JSON")), "a chunk of 4294967295 bytes was expected, found 0"),
        (whole(chunk(b"JSON", text_of()), b"1234"), "byte 49: a chunk was expected"),
        (whole(chunk(b"JSON", b"{")), "damaged at the document: Invalid JSON"),
        (whole(chunk(b"JSON", b"\xff\xfe")), "damaged at the document: Invalid JSON"),
        (whole(chunk(b"JSON", b"[]")), "damaged at the document: Input should be an object"),
        (whole(chunk(b"JSON", b"[" * 100_000)), "damaged at the document: Invalid JSON"),
        (whole(chunk(b"JSON", b"{}")), "damaged at asset: Field required"),
        (whole(chunk(b"JSON", text_of(nodes=[{"mesh": -1}]))), r"damaged at nodes\.0\.mesh"),
        (whole(chunk(b"JSON", text_of(nodes=[{"mesh": 10**30}]))), r"damaged at nodes\.0\.mesh"),
        (whole(chunk(b"JSON", text_of(nodes=[{"matrix": [1, 2]}]))), r"damaged at nodes\.0\.matrix"),
        (whole(chunk(b"JSON", text_of(nodes=[{"scale": [1, 2, float("nan")]}]))), r"damaged at nodes\.0\.scale"),
        (whole(chunk(b"JSON", text_of(nodes={}))), "damaged at nodes"),
        (whole(chunk(b"JSON", text_of(nodes=100_001 * [{}]))), "damaged at nodes: .* at most 100000"),
        (whole(chunk(b"JSON", text_of(meshes=[{"primitives": [{"attributes": {"A": "x"}}]}]))), r"attributes\.A"),
        (whole(chunk(b"JSON", b" " * (1 << 25) + text_of())), "at most 33554432 bytes of JSON"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_faults_are_named_with_their_place(content: bytes, words: str) -> None:
    with pytest.raises(ReadError, match=words) as caught:
        read_glb_document(content)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 400


def test_huge_chunks_are_refused_before_memory_is_taken() -> None:
    content = whole(struct.pack("<I4s", 2**31, b"JSON"), bytes(100))
    tracemalloc.start()
    with pytest.raises(ReadError, match="a chunk of 2147483648 bytes"):
        read_glb_document(content)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1_000_000


def test_entries_are_found_or_named() -> None:
    assert entry("ab", 1, "letter") == "b"
    with pytest.raises(ReadError, match="refers to letter 2, but its 2 are numbered from 0"):
        entry("ab", 2, "letter")
