"""Independent judges of shapes: exact self-intersection, and the limit of a grid of quads."""

from __future__ import annotations

import igl
import igl.copyleft.cgal
import numpy as np

from fabricate.mesh.polygon_mesh import PolygonMesh


def crossings(mesh: PolygonMesh) -> int:
    """Return the number of pairs of triangles that cross, by an exact test."""
    triangles, _ = igl.polygons_to_triangles(mesh.corners, mesh.offsets)
    return len(igl.copyleft.cgal.remesh_self_intersections(mesh.points, triangles, detect_only=True)[2])


def limit_points(mesh: PolygonMesh, *, around: int) -> np.ndarray:
    """Return the Catmull-Clark limit of each point of a closed grid of quads, by its mask of 3 x 3 points."""
    grid = mesh.points.reshape(around, -1, 3)
    along = np.roll(grid, 1, axis=0) + 4 * grid + np.roll(grid, -1, axis=0)
    return (np.roll(along, 1, axis=1) + 4 * along + np.roll(along, -1, axis=1)) / 36
