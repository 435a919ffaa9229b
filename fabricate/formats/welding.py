"""Making one point of those at exactly the same place: files that say every corner by itself need it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fabricate.arrays import Indices
from fabricate.mesh.polygon_mesh import PolygonMesh


def welded(mesh: PolygonMesh) -> PolygonMesh:
    """Return the same polygons with one point for all points that have equal coordinates.

    The points are numbered in the order in which the mesh's own points first name their places. -0 equals 0,
    and a coordinate that is not a number equals nothing.
    """
    points = mesh.points
    order = np.lexsort(points.T)  # stable: equal points stay in their order
    is_new = np.ones(len(points), dtype=bool)
    is_new[1:] = (points[order[1:]] != points[order[:-1]]).any(axis=1)
    firsts = order[is_new]
    number: Indices = np.argsort(np.argsort(firsts))
    new = np.zeros(len(points), dtype=np.int64)
    new[order] = number[np.cumsum(is_new) - 1]
    return replace(mesh, points=points[np.sort(firsts)], corners=new[mesh.corners])
