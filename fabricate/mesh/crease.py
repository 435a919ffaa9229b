"""Creases: the edges of a closed polygon mesh that stay sharp when it is subdivided."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fabricate.arrays import Floats
from fabricate.errors import MeshError
from fabricate.mesh.half_edges import half_edges
from fabricate.mesh.polygon_mesh import PolygonMesh

STRAIGHT = 180.0
"""The angle between the normals of two faces that lie on each other, degrees: no edge is sharper."""

WIDE = 200.0
"""A flat sector of a corner is fanned when it is wider, degrees: a straight one needs no help, a slightly wider one
would fold on a scale that nobody sees."""


def creased(mesh: PolygonMesh, *, angle: float) -> PolygonMesh:
    """Return the closed mesh with a crease on every edge at which the surface turns by `angle` or more.

    Parameters
    ----------
    mesh : PolygonMesh
        Closed and consistently oriented.
    angle : float
        Least angle between the outward normals of the two faces, degrees from 0 to 180. At 0 every edge is a
        crease: then subdivision inserts points and moves none (Garigipati 2013, 4.1).

    Raises
    ------
    MeshError
        If the angle is out of range.
    """
    if not 0.0 <= angle <= STRAIGHT:
        raise MeshError(f"a crease angle lies between 0 and 180 deg, found {angle:g} deg")
    return replace(mesh, creases=dihedral_angles(mesh) >= np.radians(angle))


def fanned_corners(mesh: PolygonMesh) -> PolygonMesh:
    """Return the closed mesh with creases also on the edges that leave a corner inside of a concave sector.

    A corner is a point where three or more creases meet; it has a sector of faces between each two of them. Where
    the faces make more than a straight angle, as round a hole in a plate, crease rules pull the edges between them
    to the wrong side of the corner, and the limit surface folds. As creases they stay where they are, and where the
    sector is flat they do not show.

    Source of the fault: Biermann, Levin and Zorin, SIGGRAPH 2000, section 3.
    """
    connectivity = half_edges(mesh)
    soft = np.flatnonzero(~mesh.creases)
    beside = connectivity.following[connectivity.twin[soft]]
    links = coo_array((np.ones(len(soft)), (soft, beside)), shape=(len(mesh.corners), len(mesh.corners)))
    sector = connected_components(links, directed=False)[1]
    wide = np.bincount(sector, corner_angles(mesh)) > np.radians(WIDE)
    corner = np.bincount(mesh.corners[mesh.creases], minlength=len(mesh.points)) > 2
    fanned = wide[sector] & corner[mesh.corners]
    return replace(mesh, creases=mesh.creases | fanned | fanned[connectivity.twin])


def corner_angles(mesh: PolygonMesh) -> Floats:
    """Return the inner angle of each face at each of its corners, (h,) radians from 0 to 2 pi, as seen from outside."""
    preceding = np.argsort(mesh.next_corner)
    here = mesh.points[mesh.corners]
    ahead, back = here[mesh.next_corner] - here, here[preceding] - here
    normals = polygon_normals(mesh)[mesh.face_of_corner]
    length = np.linalg.norm(normals, axis=1)
    sine = np.einsum("ij,ij->i", np.cross(ahead, back), normals) / np.maximum(length, np.finfo(float).tiny)
    angles: Floats = np.arctan2(sine, np.einsum("ij,ij->i", ahead, back)) % (2.0 * np.pi)
    return angles


def dihedral_angles(mesh: PolygonMesh) -> Floats:
    """Return for each half-edge of a closed mesh the angle between its face's normal and its twin's, (h,) radians.

    Flat is 0. A face without area has no normal, and makes an angle of 0 with every other.
    """
    connectivity = half_edges(mesh)
    normals = polygon_normals(mesh)
    own, other = normals[connectivity.face], normals[connectivity.face[connectivity.twin]]
    sine, cosine = np.linalg.norm(np.cross(own, other), axis=1), np.einsum("ij,ij->i", own, other)
    angles: Floats = np.arctan2(sine, cosine)
    return angles


def polygon_normals(mesh: PolygonMesh) -> Floats:
    """Return for each face, flat or not, its normal as long as twice its projected area, (f, 3) float.

    Source: Newell's method, as in Sutherland, Sproull and Schumacker, ACM Computing Surveys 6(1), 1974.
    """
    anchor = mesh.points[mesh.corners[mesh.offsets[:-1]]][mesh.face_of_corner]  # less cancellation far from 0
    begins, ends = mesh.points[mesh.corners] - anchor, mesh.points[mesh.corners[mesh.next_corner]] - anchor
    normals: Floats = np.add.reduceat(np.cross(begins, ends), mesh.offsets[:-1], axis=0)
    return normals
