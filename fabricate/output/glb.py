"""Parts as one GLB file (binary glTF 2.0), for viewers and web pages."""

from __future__ import annotations

import json
from collections.abc import Sequence
from itertools import accumulate
from pathlib import Path
from typing import Any

import numpy as np

from fabricate.output.files import write_whole
from fabricate.picture.palette import Colour, linear_light, part_colours
from fabricate.solid.part import Part

# glTF has metres and y up, parts have millimetres and z up: the nodes carry the difference (column by
# column), so that the stored coordinates stay those of the parts.
TO_METRES_Y_UP = [0.001, 0, 0, 0, 0, 0, -0.001, 0, 0, 0.001, 0, 0, 0, 0, 0, 1]
UNSIGNED_INT, FLOAT, TRIANGLES = 5125, 5126, 4  # numbers of the glTF specification
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


def write_glb(path: Path, parts: Sequence[Part]) -> None:
    """Write parts as a binary glTF scene: a node, a mesh and a plain coloured material for each.

    No normals are stored: viewers then shade every triangle flat, as the specification asks, and
    edges stay sharp.

    Raises
    ------
    ValueError
        If there are no parts, or one of them has no triangles.
    OutputError
        If the file can't be written.
    """
    empty = [part.name for part in parts if len(part.triangles) == 0]
    if empty or not parts:
        raise ValueError(f"expected parts with triangles, found {len(parts)} parts, without triangles: {empty}")
    arrays = [array for part in parts for array in _arrays(part)]
    text = json.dumps(_document(parts, [len(array) for array in arrays]), separators=(",", ":")).encode()
    chunks = _chunk(b"JSON", text, b" ") + _chunk(b"BIN\0", b"".join(arrays), b"\0")
    write_whole(path, b"glTF" + _little_endian(2, 12 + len(chunks)) + chunks)


def _arrays(part: Part) -> tuple[bytes, bytes]:
    return part.points.astype("<f4").tobytes(), part.triangles.astype("<u4").tobytes()


def _little_endian(*numbers: int) -> bytes:
    return np.array(numbers, dtype="<u4").tobytes()


def _chunk(kind: bytes, content: bytes, filler: bytes) -> bytes:
    padded = content + filler * (-len(content) % 4)
    return _little_endian(len(padded)) + kind + padded


def _document(parts: Sequence[Part], sizes: Sequence[int]) -> dict[str, Any]:
    """Return the glTF document; buffer views 2k and 2k + 1 are the points and triangles of part k."""
    colours = part_colours([part.name for part in parts])
    offsets = accumulate(sizes, initial=0)
    numbers = range(len(parts))
    return {
        "asset": {"version": "2.0", "generator": "fabricate"},
        "scene": 0,
        "scenes": [{"nodes": [*numbers]}],
        "nodes": [{"name": parts[k].name, "mesh": k, "matrix": TO_METRES_Y_UP} for k in numbers],
        "meshes": [{"name": parts[k].name, "primitives": [_primitive(k)]} for k in numbers],
        "materials": [_material(parts[k], colours[k]) for k in numbers],
        "accessors": [accessor for part, k in zip(parts, numbers, strict=True) for accessor in _accessors(part, k)],
        "bufferViews": [
            {
                "buffer": 0,
                "byteOffset": offset,
                "byteLength": size,
                "target": ELEMENT_ARRAY_BUFFER if view % 2 else ARRAY_BUFFER,
            }
            for view, (offset, size) in enumerate(zip(offsets, sizes, strict=False))
        ],
        "buffers": [{"byteLength": sum(sizes)}],
    }


def _primitive(k: int) -> dict[str, Any]:
    return {"attributes": {"POSITION": 2 * k}, "indices": 2 * k + 1, "material": k, "mode": TRIANGLES}


def _accessors(part: Part, k: int) -> tuple[dict[str, Any], dict[str, Any]]:
    return (
        {
            "bufferView": 2 * k,
            "componentType": FLOAT,
            "count": len(part.points),
            "type": "VEC3",
            "min": part.points.min(axis=0).tolist(),
            "max": part.points.max(axis=0).tolist(),
        },
        {
            "bufferView": 2 * k + 1,
            "componentType": UNSIGNED_INT,
            "count": part.triangles.size,
            "type": "SCALAR",
        },
    )


def _material(part: Part, colour: Colour) -> dict[str, Any]:
    # The specification has the base colour in linear light.
    base = [*linear_light(np.array(colour) / 255).round(6).tolist(), 1.0]
    return {
        "name": part.name,
        "pbrMetallicRoughness": {"baseColorFactor": base, "metallicFactor": 0.0, "roughnessFactor": 0.55},
    }
