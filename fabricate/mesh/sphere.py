"""Spheres of triangles, pentagons, hexagons or octagons: polyhedra with all points on the unit sphere."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import permutations, product
from typing import Literal, TypeAlias

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.errors import MeshError
from fabricate.mesh.polygon_mesh import PolygonMesh

SphereFaces: TypeAlias = Literal["triangles", "pentagons", "hexagons", "octagons"]

_GOLDEN = (1 + 5**0.5) / 2
_SILVER = 1 + 2**0.5


def sphere(*, faces: SphereFaces, frequency: int = 1) -> PolygonMesh:
    """Return the sphere whose largest faces are of the kind asked for.

    Parameters
    ----------
    faces : {"triangles", "pentagons", "hexagons", "octagons"}
        Geodesic sphere, dodecahedron, truncated icosahedron or truncated cuboctahedron.
    frequency : int
        How often each edge of the icosahedron is divided; only a sphere of triangles can be.

    Raises
    ------
    MeshError
        If the kind is unknown, the frequency is below 1, or faces other than triangles are to be divided.
    """
    if faces == "triangles":
        return geodesic_sphere(frequency=frequency)
    solids = {
        "pentagons": dodecahedron,
        "hexagons": truncated_icosahedron,
        "octagons": truncated_cuboctahedron,
    }
    if faces not in solids:
        raise MeshError(f"sphere: faces must be triangles, {', '.join(solids)}, found {faces!r}: choose one of them")
    if frequency != 1:
        raise MeshError(f"sphere: only triangles can be divided, found frequency {frequency} for {faces}: set it to 1")
    return solids[faces]()


def geodesic_sphere(*, frequency: int) -> PolygonMesh:
    """Return an icosahedron with each edge divided into `frequency` arcs of the unit sphere.

    The mesh has 10 f^2 + 2 points and 20 f^2 triangles. Inside a face the corners are blended with weights
    sin(angle * steps / f) instead of steps / f: edges are divided into equal arcs, and triangles differ
    less in size than after a flat division.

    Raises
    ------
    MeshError
        If the frequency is below 1.
    """
    if frequency < 1:
        raise MeshError(f"sphere: frequency must be 1 or more, found {frequency}: choose 1, 2, 3, ...")
    solid = _icosahedron()
    faces = solid.corners.reshape(-1, 3)
    steps, triangles = _triangular_grid(frequency)
    _, first, point_of = np.unique(_lattice_keys(faces, steps), return_index=True, return_inverse=True)
    edge_angle = np.arccos(1 / 5**0.5)
    blended = np.sin(edge_angle / frequency * steps) @ solid.points[faces]
    corners = point_of.reshape(len(faces), len(steps))[:, triangles].ravel()
    points = _on_sphere(blended.reshape(-1, 3)[first])
    return PolygonMesh(points, corners, np.arange(0, len(corners) + 1, 3))


def dodecahedron() -> PolygonMesh:
    """Return the regular dodecahedron: 20 points, 12 pentagons."""
    return _convex_solid(_dodecahedron_points(), _icosahedron_points())


def truncated_icosahedron() -> PolygonMesh:
    """Return the truncated icosahedron (a football): 60 points, 12 pentagons, 20 hexagons."""
    solid = _icosahedron()
    start, end = solid.points[solid.corners], solid.points[solid.corners[solid.next_corner]]
    normals = np.concatenate([_icosahedron_points(), _dodecahedron_points()])
    return _convex_solid((2 * start + end) / 3, normals)


def truncated_cuboctahedron() -> PolygonMesh:
    """Return the truncated cuboctahedron: 48 points, 12 squares, 8 hexagons, 6 octagons."""
    points = _signed(permutations((1.0, _SILVER, 2 * _SILVER - 1)))
    normals = [_cyclic(1.0, 1.0, 0.0), [(1.0, 1.0, 1.0)], _cyclic(1.0, 0.0, 0.0)]
    return _convex_solid(points, np.concatenate([_signed(group) for group in normals]))


def _icosahedron() -> PolygonMesh:
    return _convex_solid(_icosahedron_points(), _dodecahedron_points())


def _icosahedron_points() -> Floats:
    return _signed(_cyclic(0.0, 1.0, _GOLDEN))


def _dodecahedron_points() -> Floats:
    return _signed([(1.0, 1.0, 1.0), *_cyclic(0.0, _GOLDEN, 1 / _GOLDEN)])


def _cyclic(x: float, y: float, z: float) -> list[tuple[float, float, float]]:
    return [(x, y, z), (z, x, y), (y, z, x)]


def _signed(points: Iterable[tuple[float, ...]]) -> Floats:
    """Return every point with all combinations of signs, each once, in lexicographic order."""
    signs = np.array(list(product((-1.0, 1.0), repeat=3)))
    combined = np.array(list(points))[:, None] * signs
    return np.unique(combined.reshape(-1, 3) + 0.0, axis=0)  # -0.0 becomes 0.0


def _on_sphere(points: Floats) -> Floats:
    unit: Floats = points / np.linalg.norm(points, axis=1, keepdims=True)
    return unit


def _convex_solid(points: Floats, normals: Floats) -> PolygonMesh:
    """Return the polyhedron with these points, moved onto the unit sphere, and a face for each normal.

    A face has the points farthest along its normal, in the order of their angle round it. So no
    triangulated hull is needed whose coplanar triangles would have to be merged.
    """
    points, normals = _on_sphere(points), _on_sphere(normals)
    heights = normals @ points.T
    face, point = np.nonzero(heights > heights.max(axis=1, keepdims=True) - 1e-9)
    offsets = np.searchsorted(face, np.arange(len(normals) + 1))
    start, normal = points[point[offsets[face]]], normals[face]
    sine = np.einsum("ij,ij->i", normal, np.cross(start, points[point]))
    cosine = np.einsum("ij,ij->i", start, points[point]) - heights[face, point] ** 2
    return PolygonMesh(points, point[np.lexsort((np.arctan2(sine, cosine), face))], offsets)


def _triangular_grid(frequency: int) -> tuple[Indices, Indices]:
    """Return the points of a triangle divided f times and its small triangles.

    Points are (k, 3) int: steps towards each of the three corners, adding up to f. Triangles are
    (f^2, 3) int indices into them.
    """
    i, j = np.nonzero(np.add.outer(np.arange(frequency + 1), np.arange(frequency + 1)) <= frequency)
    number = np.zeros((frequency + 1, frequency + 1), dtype=np.int64)
    number[i, j] = np.arange(len(i))
    a, b = i[i + j < frequency], j[i + j < frequency]
    upright = np.stack([number[a, b], number[a + 1, b], number[a, b + 1]], axis=1)
    c, d = i[i + j < frequency - 1], j[i + j < frequency - 1]
    inverted = np.stack([number[c + 1, d], number[c + 1, d + 1], number[c, d + 1]], axis=1)
    return np.stack([i, j, frequency - i - j], axis=1), np.concatenate([upright, inverted])


def _lattice_keys(faces: Indices, steps: Indices) -> Indices:
    """Return one integer per face and lattice point, equal where neighbouring faces share the point.

    A point is known by the corners it is blended from and its steps towards each; corners it takes
    no step towards are left out, so that both faces at an edge name its points alike.
    """
    base = steps.max() + 1
    digits = np.where(steps > 0, faces[:, None] * base + steps, 0)
    digits.sort(axis=-1)
    keys: Indices = digits @ (base * (faces.max() + 1)) ** np.arange(3)
    return keys.ravel()
