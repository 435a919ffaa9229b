"""Where the nodes of a glTF scene put its meshes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, frozen
from fabricate.errors import ReadError
from fabricate.formats.read_glb_document import Document, Node, entry

_INSTANCING = "EXT_mesh_gpu_instancing"


@dataclass(frozen=True, eq=False)
class PlacedMesh:
    """A mesh of the document and its place: the place of (x, y, z) is the begin of (x, y, z, 1) @ transform."""

    mesh: int
    transform: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "transform", frozen(self.transform, np.float64, (4, 4)))


def placed_meshes(document: Document) -> list[PlacedMesh]:
    """Return all meshes of the scene that the document shows, from the top down.

    A document without nodes shows every mesh where it is. Skinned meshes are not posed: they stand as they
    were modelled, whatever node they are in.

    Raises
    ------
    ReadError
        If a node is below itself or below several others, or places its mesh several times.
    """
    if not document.nodes:
        return [PlacedMesh(mesh, np.eye(4)) for mesh in range(len(document.meshes))]
    placed, reached = [], set()
    waiting = [(node, np.eye(4)) for node in reversed(_tops(document))]
    while waiting:
        number, above = waiting.pop()
        if number in reached:
            raise ReadError(
                f"node {number} was expected in one place of the scene, found it in several or below itself"
            )
        reached.add(number)
        node = entry(document.nodes, number, "node")
        with np.errstate(over="ignore", invalid="ignore"):  # infinities are judged later, like all others
            transform = _local(node) @ above
        if node.mesh is not None:
            _check_single(node, number)
            placed.append(PlacedMesh(node.mesh, transform if node.skin is None else np.eye(4)))
        waiting += [(child, transform) for child in reversed(node.children)]
    return placed


def _tops(document: Document) -> list[int]:
    if document.scenes:
        return list(entry(document.scenes, document.scene or 0, "scene").nodes)
    children = {child for node in document.nodes for child in node.children}
    return [number for number in range(len(document.nodes)) if number not in children]


def _check_single(node: Node, number: int) -> None:
    if _INSTANCING in node.extensions:
        raise ReadError(f"node {number} needs {_INSTANCING}, which cannot be read; save the copies as nodes")


def _local(node: Node) -> Floats:
    """Return the node's own matrix, for points as rows: what glTF writes column after column, read row after row."""
    if node.matrix is not None:
        return np.array(node.matrix, dtype=np.float64).reshape(4, 4)
    matrix = np.eye(4)
    matrix[:3, :3] = np.array(node.scale)[:, None] * _rotation(node.rotation).T
    matrix[3, :3] = node.translation
    return matrix


def _rotation(quaternion: tuple[float, float, float, float]) -> Floats:
    """Return the matrix that turns columns by a quaternion (x, y, z, w); none that is zero turns anything."""
    length = float(np.linalg.norm(quaternion))
    x, y, z, w = np.divide(quaternion, length) if 0 < length < np.inf else (0.0, 0.0, 0.0, 1.0)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
