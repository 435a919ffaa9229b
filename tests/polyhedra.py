"""Closed polygon meshes to test on: small named ones, and Hypothesis strategies of random ones."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
from fabricate.mesh.closed import checked_closed
from fabricate.mesh.cube import cube
from fabricate.mesh.knot import trefoil
from fabricate.mesh.pierced import double_torus, genus_six, triple_torus
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.torus import torus

Faces = list[list[int]]

HANDLES = {
    "torus": (torus(around=5, across=3, tube=0.4), 1),
    "even torus": (torus(around=8, across=4, tube=0.4), 1),
    "knot": (trefoil(around=24, across=3, tube=0.4), 1),
    "double torus": (double_torus(), 2),
    "triple torus": (triple_torus(), 3),
    "genus six": (genus_six(), 6),
}
"""Meshes with handles, and how many they have."""

seeds = st.integers(0, 2**32 - 1)


def face_lists(mesh: PolygonMesh) -> Faces:
    return [mesh.corners[begin:end].tolist() for begin, end in pairwise(mesh.offsets.tolist())]


def directed_edges(faces: Faces) -> list[tuple[int, int]]:
    return [edge for face in faces for edge in pairwise([*face, face[0]])]


def on_sphere(points: np.ndarray) -> np.ndarray:
    return np.asarray(points / np.linalg.norm(points, axis=1, keepdims=True))


def tetrahedron() -> PolygonMesh:
    return hull(np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], dtype=float))


def octahedron() -> PolygonMesh:
    return hull(np.concatenate([np.eye(3), -np.eye(3)]))


def bipyramid(sides: int) -> PolygonMesh:
    """Return two points of valence `sides` above and below a ring of points of valence 4."""
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros(sides)], axis=1)
    return hull(np.concatenate([ring, [[0, 0, 0.9], [0, 0, -1.1]]]))


def beads(count: int) -> PolygonMesh:
    """Return quads on a ring of `count` points, two above each other between neighbours of the ring.

    Such a pair shares three points, and the one in the middle has valence 2.
    """
    angle = np.pi * np.arange(2 * count) / count
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros(2 * count)], axis=1)
    top, bottom = 2 * count, 2 * count + 1
    steps = [(k, k + 1, (k + 2) % (2 * count)) for k in range(0, 2 * count, 2)]
    upper, lower = [[*step, top] for step in steps], [[*step[::-1], bottom] for step in steps]
    return PolygonMesh.from_faces(np.concatenate([ring, [[0, 0, 0.8], [0, 0, -0.8]]]), upper + lower)


def hull(points: np.ndarray) -> PolygonMesh:
    """Return the triangles of the convex hull, outward; all points must lie on it."""
    found = ConvexHull(points)
    a, b, c = np.moveaxis(points[found.simplices], 1, 0)
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), found.equations[:, :3]) < 0
    faces = np.where(inward[:, None], found.simplices[:, ::-1], found.simplices)
    return PolygonMesh.from_faces(points, faces.tolist())


def dual(mesh: PolygonMesh) -> PolygonMesh:
    """Return the mesh with a point at the centre of each face and a face round each point."""
    faces = face_lists(mesh)
    face_of = {edge: number for number, face in enumerate(faces) for edge in directed_edges([face])}
    rings: Faces = []
    for point in range(len(mesh.points)):
        ring: list[int] = []
        head = next(b for a, b in face_of if a == point)
        while not ring or face_of[point, head] != ring[0]:
            face = faces[face_of[point, head]]
            ring.append(face_of[point, head])
            head = face[face.index(point) - 1]
        rings.append(ring)
    # on the sphere, as centres alone make parallelograms, whose refined points may coincide
    centres = on_sphere(np.array([mesh.points[face].mean(axis=0) for face in faces]))
    return PolygonMesh.from_faces(centres, rings)


def with_merged_faces(mesh: PolygonMesh, rng: np.random.Generator, *, count: int) -> PolygonMesh:
    """Return the mesh with up to `count` edges removed, so that pairs of faces become one polygon."""
    faces = face_lists(mesh)
    for a, b in rng.permutation(directed_edges(faces)).tolist():
        left = next((face for face in faces if (a, b) in directed_edges([face])), None)
        right = next((face for face in faces if (b, a) in directed_edges([face])), None)
        if count == 0 or left is None or right is None or set(left) & set(right) != {a, b}:
            continue
        joined = _from(left, b) + _from(right, a)[1:-1]
        rest = [face for face in faces if face is not left and face is not right]
        busy = min(sum(point in face for face in rest) for point in (a, b)) > 0
        if busy and all(set(face) != set(joined) for face in rest):
            faces, count = [*rest, joined], count - 1
    return PolygonMesh.from_faces(mesh.points, faces)


def with_split_edges(mesh: PolygonMesh, rng: np.random.Generator, *, count: int) -> PolygonMesh:
    """Return the mesh with a point of valence 2 in the middle of `count` of its edges."""
    faces = face_lists(mesh)
    edges = [edge for edge in directed_edges(faces) if edge[0] < edge[1]]
    points = mesh.points
    for a, b in rng.permutation(edges)[:count].tolist():
        faces = [_with_point_between(_with_point_between(face, a, b, len(points)), b, a, len(points)) for face in faces]
        points = np.concatenate([points, [0.55 * points[a] + 0.55 * points[b]]])
    return PolygonMesh.from_faces(points, faces)


def _from(face: list[int], start: int) -> list[int]:
    place = face.index(start)
    return face[place:] + face[:place]


def _with_point_between(face: list[int], a: int, b: int, point: int) -> list[int]:
    if (a, b) not in directed_edges([face]):
        return face
    return [*_from(face, b), point]


@st.composite
def polyhedra(draw: st.DrawFn) -> PolygonMesh:
    """Draw a polyhedron like a sphere: a convex hull, perhaps dualised, with merged faces and split edges."""
    rng = np.random.default_rng(draw(seeds))
    mesh = hull(on_sphere(rng.normal(size=(draw(st.integers(4, 14)), 3))))
    if draw(st.booleans()):
        mesh = dual(mesh)
    mesh = with_merged_faces(mesh, rng, count=draw(st.integers(0, 5)))
    return checked_closed(with_split_edges(mesh, rng, count=draw(st.integers(0, 2))))


def surfaces() -> st.SearchStrategy[PolygonMesh]:
    """Draw a closed mesh of any genus up to 6."""
    handled = st.sampled_from([mesh for mesh, _ in HANDLES.values()])
    return st.one_of(polyhedra(), polyhedra(), handled)


def quad_meshes() -> st.SearchStrategy[QuadMesh]:
    """Draw the tiles of a closed mesh of any genus up to 6; some tiles share both yellow corners."""
    ready = [beads(2), beads(3), beads(7), cube(divisions=1), cube(divisions=4), HANDLES["even torus"][0]]
    return st.one_of(surfaces().map(lambda mesh: subdivided(mesh, levels=1)), st.sampled_from(ready).map(two_coloured))


def named() -> dict[str, PolygonMesh]:
    """Return coarse meshes with valences from 2 to 8, small and large faces, and handles."""
    return {
        "tetrahedron": tetrahedron(),
        "cube": cube(divisions=1),
        "octahedron": octahedron(),
        "beads": beads(3),
        "bipyramid 5": bipyramid(5),
        "bipyramid 8": bipyramid(8),
        "dual of bipyramid 8": dual(bipyramid(8)),
        "split cube": with_split_edges(cube(divisions=1), np.random.default_rng(5), count=3),
        **{name: mesh for name, (mesh, _) in HANDLES.items()},
    }
