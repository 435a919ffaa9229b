"""Ways to break a mesh without moving a point, and meshes to put together."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from polyhedra import Faces, face_lists

from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh


def box(size: float = 1.0, at: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> PolygonMesh:
    """Return a cube of 6 quads with edges of length `size` round the point `at`."""
    mesh = cube(divisions=1)
    return mesh.moved((mesh.points / np.ptp(mesh.points[:, 0])) * size + np.array(at))


def with_faces(mesh: PolygonMesh, faces: Faces) -> PolygonMesh:
    return PolygonMesh.from_faces(mesh.points, faces)


def united(*meshes: PolygonMesh) -> PolygonMesh:
    """Return all meshes in one, with their own points each."""
    shifts = np.cumsum([0, *(len(mesh.points) for mesh in meshes)]).tolist()
    faces = [
        [corner + shift for corner in face]
        for mesh, shift in zip(meshes, shifts, strict=False)
        for face in face_lists(mesh)
    ]
    return PolygonMesh.from_faces(np.concatenate([mesh.points for mesh in meshes]), faces)


def turned(mesh: PolygonMesh, which: set[int]) -> PolygonMesh:
    """Return the mesh with some faces wound the other way."""
    return with_faces(mesh, [face[::-1] if n in which else face for n, face in enumerate(face_lists(mesh))])


def without(mesh: PolygonMesh, which: set[int]) -> PolygonMesh:
    """Return the mesh without some faces; the points stay."""
    return with_faces(mesh, [face for n, face in enumerate(face_lists(mesh)) if n not in which])


def inside_out(mesh: PolygonMesh) -> PolygonMesh:
    return turned(mesh, set(range(len(mesh.offsets))))


def unwelded(mesh: PolygonMesh) -> PolygonMesh:
    """Return the mesh with an own point for every corner."""
    return PolygonMesh(mesh.points[mesh.corners], np.arange(len(mesh.corners)), mesh.offsets)


def shuffled(mesh: PolygonMesh, rng: np.random.Generator) -> PolygonMesh:
    """Return the mesh with its faces in another order, each beginning with another corner."""
    faces = face_lists(mesh)
    starts = rng.integers(0, 3, len(faces)).tolist()
    rolled = [face[start:] + face[:start] for face, start in zip(faces, starts, strict=True)]
    return with_faces(mesh, [rolled[n] for n in rng.permutation(len(faces)).tolist()])


def triangles(mesh: PolygonMesh) -> np.ndarray:
    """Return a plain fan of each polygon."""
    return np.array([[face[0], a, b] for face in face_lists(mesh) for a, b in pairwise(face[1:])])


def moebius(count: int = 12) -> PolygonMesh:
    """Return a strip of `count` quads with half a twist, radius 1 and width 0.5."""
    around = 2 * np.pi * np.arange(count) / count
    rows = []
    for side in (-0.25, 0.25):
        radius = 1 + side * np.cos(around / 2)
        rows.append(np.column_stack([radius * np.cos(around), radius * np.sin(around), side * np.sin(around / 2)]))
    strip = [[k, k + 1, count + k + 1, count + k] for k in range(count - 1)]
    return PolygonMesh.from_faces(np.concatenate(rows), [*strip, [count - 1, count, 0, 2 * count - 1]])
