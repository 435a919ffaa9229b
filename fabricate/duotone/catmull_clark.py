"""Catmull-Clark subdivision of any closed polygon mesh, with the sparse matrix that does it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array, vstack

from fabricate.arrays import Floats, Indices, Mask
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.mesh.half_edges import HalfEdges, half_edges
from fabricate.mesh.polygon_mesh import PolygonMesh


class Subdivision(NamedTuple):
    """A refined mesh and the matrix that made its points: `mesh.points == matrix @ old.points`."""

    mesh: QuadMesh
    matrix: csr_array


def catmull_clark(mesh: PolygonMesh | QuadMesh) -> Subdivision:
    """Subdivide once; every corner of the old mesh becomes one quad.

    New points are the old vertices, then face points (both yellow), then edge points (blue), so a mesh
    with V vertices, E edges and F faces gives V + F yellow points, E blue ones and 2 E quads. Quad h
    belongs to corner h and runs vertex, next edge point, face point, previous edge point.

    Creases are infinitely sharp and go on along both halves of their edge. Where one ends, at a dart, the vertex
    is smooth; where three or more meet, at a corner, it stays where it is.

    Source: Catmull and Clark, Computer-Aided Design 10(6), 1978; creases after DeRose, Kass and Truong, SIGGRAPH
    1998; colours after Garigipati 2013, 2.4.
    """
    connectivity = mesh.half_edges if isinstance(mesh, QuadMesh) else half_edges(mesh)
    vertices, faces = len(mesh.points), int(connectivity.face[-1]) + 1
    edge = connectivity.edge
    corner_edge = vertices + faces + edge
    tiles = np.stack(
        [connectivity.tail, corner_edge, vertices + connectivity.face, corner_edge[connectivity.preceding]],
        axis=1,
    )
    matrix = _matrix(connectivity, edge, vertices, faces)
    if mesh.creases.any():
        matrix = _creased(matrix, connectivity, edge, mesh.creases, vertices)
    yellow = np.arange(matrix.shape[0]) < vertices + faces
    creases = np.zeros((len(tiles), 4), dtype=bool)
    creases[:, 0], creases[:, 3] = mesh.creases, mesh.creases[connectivity.preceding]
    quads = QuadMesh(matrix @ mesh.points, tiles, _twins(connectivity), yellow, creases.ravel())
    return Subdivision(quads, matrix)


def subdivided(mesh: PolygonMesh, *, levels: int) -> QuadMesh:
    """Return the mesh after `levels` >= 1 Catmull-Clark steps."""
    quads = catmull_clark(mesh).mesh
    for _ in range(levels - 1):
        quads = catmull_clark(quads).mesh
    return quads


def _twins(old: HalfEdges) -> Indices:
    """Return the twins of the new half-edges, from the old connectivity alone.

    Side 0 of quad h is the first half of old half-edge h, side 3 the second half of the one before it;
    sides 1 and 2 run to and from the face point and meet the neighbouring corners of the same face.
    """
    sides = [
        4 * old.following[old.twin] + 3,
        4 * old.following + 2,
        4 * old.preceding + 1,
        4 * old.twin[old.preceding],
    ]
    return np.stack(sides, axis=1).ravel()


def _matrix(old: HalfEdges, edge: Indices, vertices: int, faces: int) -> csr_array:
    """Return the (V + F + E, V) matrix of the vertex, face and edge rules."""
    corners = np.arange(len(old.tail))
    sizes = np.bincount(old.face, minlength=faces)
    valence = np.bincount(old.tail, minlength=vertices)
    indptr = np.concatenate([[0], np.cumsum(sizes)])
    face_rule = csr_array((1.0 / sizes[old.face], old.tail, indptr), shape=(faces, vertices))

    # edge point: mean of its two ends and its two face points
    edges = len(corners) // 2
    quarter = np.full(len(corners), 0.25)
    ends = coo_array((quarter, (edge, old.tail)), shape=(edges, vertices)).tocsr()
    sides = coo_array((quarter, (edge, old.face)), shape=(edges, faces)).tocsr()
    edge_rule = ends + sides @ face_rule

    # vertex of valence n: (n - 2) / n itself + 1 / n^2 of each neighbour + 1 / n^2 of each face point
    share = 1.0 / np.square(valence[old.tail].astype(np.float64))
    around = coo_array((share, (old.tail, old.tail[old.following])), shape=(vertices, vertices)).tocsr()
    fans = coo_array((share, (old.tail, old.face)), shape=(vertices, faces)).tocsr()
    diagonal = coo_array(
        ((valence - 2.0) / valence, (np.arange(vertices), np.arange(vertices))), shape=(vertices, vertices)
    ).tocsr()
    vertex_rule = diagonal + around + fans @ face_rule
    return csr_array(vstack([vertex_rule, face_rule, edge_rule], format="csr"))


def _creased(smooth: csr_array, old: HalfEdges, edge: Indices, creases: Mask, vertices: int) -> csr_array:
    """Return the matrix of the smooth rules with the rows of creases and corners replaced.

    The middle of each crease; 1/8, 6/8, 1/8 along the two creases that meet at a vertex; corners stay.
    """
    sharp = np.flatnonzero(creases)
    tail, head = old.tail[sharp], old.tail[old.twin[sharp]]
    meeting = np.bincount(tail, minlength=vertices)
    kept: Floats = np.ones(smooth.shape[0])
    kept[:vertices][meeting >= 2] = 0.0
    first_edge = smooth.shape[0] - len(old.tail) // 2
    kept[first_edge + edge[sharp]] = 0.0
    through = meeting[tail] == 2
    corners = np.flatnonzero(meeting > 2)
    rows = [first_edge + edge[sharp], tail[through], tail[through], corners]
    columns = [tail, tail[through], head[through], corners]
    weights = [0.5, 0.375, 0.125, 1.0]  # each half-edge of a crease gives its share
    values = np.concatenate([np.full(len(r), weight) for r, weight in zip(rows, weights, strict=True)])
    rules = coo_array((values, (np.concatenate(rows), np.concatenate(columns))), shape=smooth.shape).tocsr()
    matrix = csr_array(diags_array(kept) @ smooth + rules)
    matrix.eliminate_zeros()
    return matrix
