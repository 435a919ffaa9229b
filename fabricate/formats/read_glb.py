"""Reading GLB files, the binary form of glTF 2.0: all triangles of the scene as one mesh."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.pieces import Piece, joined
from fabricate.formats.read_glb_accessor import read_indices, read_points
from fabricate.formats.read_glb_document import Document, Glb, Primitive, entry, read_glb_document
from fabricate.formats.read_glb_scene import PlacedMesh, placed_meshes
from fabricate.formats.strips import fan_triangles, strip_triangles
from fabricate.formats.welding import welded
from fabricate.mesh.polygon_mesh import PolygonMesh

_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_COMPRESSIONS = ("KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression")
_MOST_PIECES = 100_000


def read_glb(content: bytes, *, limits: ReadLimits = DEFAULT_LIMITS) -> PolygonMesh:
    """Read the triangles, strips and fans of the scene that a GLB file shows; points and lines are passed over.

    Points at exactly the same place become one, as glTF has several wherever normals or colours differ.
    Coordinates are kept as they are: metres, and y upward. Morph targets and skins do not move anything.

    Raises
    ------
    ReadError
        If the file is damaged, compressed, has its data elsewhere, or more triangles than the limits.
    """
    glb = read_glb_document(content)
    _check_readable(glb.document)
    placed = [
        (primitive, where.transform)
        for where in placed_meshes(glb.document)
        for primitive in _primitives(glb.document, where)
    ]
    _check_sizes(glb.document, [primitive for primitive, _ in placed], limits)
    numbers = {primitive.attributes["POSITION"] for primitive, _ in placed}
    points = {number: read_points(glb, number) for number in sorted(numbers)}
    pieces = [_piece(glb, primitive, points[primitive.attributes["POSITION"]], where) for primitive, where in placed]
    return welded(joined(pieces))


def _check_readable(document: Document) -> None:
    for name in _COMPRESSIONS:
        if name in document.extensions_required:
            raise ReadError(f"the file is compressed ({name}), which cannot be read; save it without compression")


def _primitives(document: Document, placed: PlacedMesh) -> list[Primitive]:
    """Return the parts of a mesh that have triangles."""
    primitives = entry(document.meshes, placed.mesh, "mesh").primitives
    return [part for part in primitives if part.mode in {_TRIANGLES, _STRIP, _FAN} and "POSITION" in part.attributes]


def _check_sizes(document: Document, primitives: list[Primitive], limits: ReadLimits) -> None:
    """Count before any number is read: accessors and nodes may name the same bytes again and again."""
    if len(primitives) > _MOST_PIECES:
        raise ReadError(f"at most {_MOST_PIECES} placed primitives are read, found {len(primitives)}")
    limits.check_faces(sum(_triangle_count(document, primitive) for primitive in primitives))
    numbers = {primitive.attributes["POSITION"] for primitive in primitives}
    limits.check_points(sum(entry(document.accessors, number, "accessor").count for number in numbers))


def _triangle_count(document: Document, primitive: Primitive) -> int:
    corners = primitive.attributes["POSITION"] if primitive.indices is None else primitive.indices
    count = entry(document.accessors, corners, "accessor").count
    if primitive.mode != _TRIANGLES:
        return max(count - 2, 0)
    if count % 3:
        raise ReadError(f"accessor {corners} was expected to hold whole triangles, found {count} corners")
    return count // 3


def _piece(glb: Glb, primitive: Primitive, points: Floats, transform: Floats) -> Piece:
    corners: Indices = np.arange(len(points))
    if primitive.indices is not None:
        corners = read_indices(glb, primitive.indices, points=len(points))
    used, triangles = np.unique(_triangles(corners, primitive.mode), return_inverse=True)
    return Piece(points[used], triangles.reshape(-1, 3), transform)


def _triangles(corners: Indices, mode: int) -> Indices:
    if mode == _STRIP:
        return strip_triangles(corners)
    return fan_triangles(corners) if mode == _FAN else corners.reshape(-1, 3)
