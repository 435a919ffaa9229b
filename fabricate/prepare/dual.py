"""The dual of a triangle mesh: mostly hexagons, one round every point."""

from __future__ import annotations

import numpy as np

from fabricate.errors import MeshError
from fabricate.mesh.half_edges import half_edges
from fabricate.mesh.polygon_mesh import PolygonMesh


def dual(mesh: PolygonMesh) -> PolygonMesh:
    """Return the mesh with a face round each point, whose corners are the centroids of the triangles there.

    V points, E edges and F triangles become V faces, E edges and F points, so the genus stays. Face v belongs to
    point v and point f to triangle f; a point with n triangles becomes a polygon of n corners. Outward stays
    outward.

    Parameters
    ----------
    mesh : PolygonMesh
        Closed and consistently oriented, triangles only.

    Raises
    ------
    MeshError
        If a face is not a triangle, or fewer than three meet at a point.
    """
    if (mesh.face_sizes != 3).any():
        face = int(np.argmax(mesh.face_sizes != 3))
        raise MeshError(f"a dual is made of triangles, found {mesh.face_sizes[face]} corners in face {face}")
    valence = np.bincount(mesh.corners, minlength=len(mesh.points))
    if (valence < 3).any():
        raise MeshError(f"a dual needs three triangles at every point, found {valence.min()} at {valence.argmin()}")
    connectivity = half_edges(mesh)
    # counter-clockwise round a point, the triangle across the side that ends there follows
    turned = connectivity.twin[connectivity.preceding]
    first = np.zeros(len(mesh.points), dtype=np.int64)
    first[mesh.corners[::-1]] = np.arange(len(mesh.corners))[::-1]
    offsets = np.concatenate([[0], np.cumsum(valence)])
    corners = np.zeros(len(mesh.corners), dtype=np.int64)
    place, side = np.arange(len(mesh.points)), first
    for step in range(int(valence.max())):
        place, side = place[valence[place] > step], side[valence[place] > step]
        corners[offsets[place] + step] = connectivity.face[side]
        side = turned[side]
    centroids = mesh.points[mesh.corners.reshape(-1, 3)].mean(axis=1)
    return PolygonMesh(centroids, corners, offsets)
