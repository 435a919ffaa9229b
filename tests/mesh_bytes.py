"""Mesh files of every format, written by hand as bytes from points and faces."""

from __future__ import annotations

import io
import json
import struct
import zipfile
from collections.abc import Callable
from typing import Any

import numpy as np

Writer = Callable[[list[str], list[list[int]]], bytes]

POINTS = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"]
FACES = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
RELATIONS = (
    '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="rel0" '
    'Target="/3D/other.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
)


def obj(points: list[str], faces: list[list[int]]) -> bytes:
    rows = [" ".join(str(corner + 1) for corner in face) for face in faces]
    return "".join([*(f"v {point}\n" for point in points), *(f"f {row}\n" for row in rows)]).encode()


def rows(points: list[str], faces: list[list[int]]) -> str:
    return "\n".join([*points, *(" ".join(map(str, [len(face), *face])) for face in faces)]) + "\n"


def off(points: list[str], faces: list[list[int]]) -> bytes:
    return f"OFF\n{len(points)} {len(faces)} 0\n{rows(points, faces)}".encode()


def binary_off(points: list[str], faces: list[list[int]]) -> bytes:
    counts = np.array([len(points), len(faces), 0], dtype=">i4").tobytes()
    polygons = b"".join(np.array([len(face), *face, 0], dtype=">i4").tobytes() for face in faces)
    return b"OFF BINARY\n" + counts + coordinates(points, ">f4").tobytes() + polygons


def ply_header(form: str, points: int, faces: int, *, kind: str = "face", length: str = "uchar") -> str:
    axes = "".join(f"property float {axis}\n" for axis in "xyz")
    lists = f"property list {length} int vertex_indices\n"
    return f"ply\nformat {form} 1.0\nelement vertex {points}\n{axes}element {kind} {faces}\n{lists}end_header\n"


def ply(points: list[str], faces: list[list[int]]) -> bytes:
    return (ply_header("ascii", len(points), len(faces)) + rows(points, faces)).encode()


def binary_ply(points: list[str], faces: list[list[int]]) -> bytes:
    lists = b"".join(bytes([len(face)]) + np.array(face, dtype="<i4").tobytes() for face in faces)
    header = ply_header("binary_little_endian", len(points), len(faces))
    return header.encode() + coordinates(points, "<f4").tobytes() + lists


def big_endian_ply(points: list[str], faces: list[list[int]]) -> bytes:
    lists = b"".join(bytes([len(face)]) + np.array(face, dtype=">i4").tobytes() for face in faces)
    return (
        ply_header("binary_big_endian", len(points), len(faces)).encode() + coordinates(points, ">f4").tobytes() + lists
    )


def strip_ply(points: list[str], faces: list[list[int]]) -> bytes:
    """Return a PLY file with one strip for each triangle."""
    strip = [corner for face in faces for corner in [*face, -1]][:-1]
    header = ply_header("binary_little_endian", len(points), 1, kind="tristrips", length="int")
    lists = np.array([len(strip), *strip], dtype="<i4").tobytes()
    return header.encode() + coordinates(points, "<f4").tobytes() + lists


def stl(points: list[str], faces: list[list[int]]) -> bytes:
    facets = ["".join(f"vertex {points[corner]}\n" for corner in face) for face in faces]
    body = "".join(f"facet normal 0 0 0\nouter loop\n{facet}endloop\nendfacet\n" for facet in facets)
    return f"solid\n{body}endsolid\n".encode()


def binary_stl(points: list[str], faces: list[list[int]]) -> bytes:
    corners = coordinates(points, "<f4")[np.array(faces, dtype=int)]
    triangles = b"".join(bytes(12) + triangle.tobytes() + bytes(2) for triangle in corners)
    return b"solid".ljust(80, b"\0") + len(faces).to_bytes(4, "little") + triangles


def three_mf(points: list[str], faces: list[list[int]]) -> bytes:
    item = '<build><item objectid="1"/></build>'
    return package(model(f'<object id="1">{mesh_3mf(points, faces)}</object>', item))


def mesh_3mf(points: list[str], faces: list[list[int]]) -> str:
    vertices = "".join('<vertex x="{}" y="{}" z="{}"/>'.format(*point.split()) for point in points)
    triangles = "".join('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*face) for face in faces)
    return f"<mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh>"


def model(objects: str, build: str = "", *, attributes: str = "") -> str:
    return f'<model xmlns="{CORE}" {attributes}><resources>{objects}</resources>{build}</model>'


def package(text: str | bytes, *, compression: int = zipfile.ZIP_DEFLATED, **parts: str) -> bytes:
    """Return a zip archive with the text as its usual model part, and other parts under 3D/NAME.model."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", compression) as archive:
        for name, part in {"3dmodel": text, **parts}.items():
            archive.writestr(zipfile.ZipInfo(f"3D/{name}.model"), part, compression)
    return content.getvalue()


def glb(points: list[str], faces: list[list[int]]) -> bytes:
    places = coordinates(points, "<f4").tobytes()
    corners = np.array(faces, dtype="<u2").tobytes()
    accessors = [accessor(0, len(points), 5126, "VEC3"), accessor(1, 3 * len(faces), 5123, "SCALAR")]
    primitive = {"attributes": {"POSITION": 0}, "indices": 1}
    return glb_bytes(gltf(accessors, [len(places), len(corners)], [[primitive]], nodes=[{"mesh": 0}]), places + corners)


def accessor(view: int, count: int, kind: int, shape: str, **more: Any) -> dict[str, Any]:
    return {"bufferView": view, "count": count, "componentType": kind, "type": shape, **more}


def gltf(
    accessors: list[dict[str, Any]], lengths: list[int], meshes: list[list[dict[str, Any]]], **more: Any
) -> dict[str, Any]:
    """Return a document over one buffer whose views follow each other."""
    begins = np.cumsum([0, *lengths]).tolist()
    views = [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, size in zip(begins, lengths, strict=False)]
    return {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": begins[-1]}],
        "bufferViews": views,
        "accessors": accessors,
        "meshes": [{"primitives": primitives} for primitives in meshes],
        **more,
    }


def glb_bytes(document: dict[str, Any], binary: bytes, *, version: int = 2) -> bytes:
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += bytes(-len(binary) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", version, 12 + len(chunks)) + chunks


def coordinates(points: list[str], kind: str) -> np.ndarray:
    with np.errstate(over="ignore"):  # what a file cannot hold becomes infinite in it
        return np.array([point.split() for point in points], dtype=float).astype(kind).reshape(-1, 3)


TEXTS: list[Writer] = [obj, off, ply, stl]
INDEXED: list[Writer] = [obj, off, ply, binary_ply]
ALL: list[Writer] = [*TEXTS, binary_off, binary_ply, big_endian_ply, strip_ply, binary_stl, three_mf, glb]


def ply_with_values(name: str, values: list[float]) -> bytes:
    """Return a text PLY of the tetrahedron whose points have a number each."""
    header = ply_header("ascii", len(POINTS), len(FACES)).replace(
        "element face", f"property float {name}\nelement face"
    )
    points = [f"{point} {value}" for point, value in zip(POINTS, values, strict=True)]
    return (header + rows(points, FACES)).encode()
