"""Lids on small holes, so that what is wrapped round a surface does not get inside."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.mesh.edges import Edges, boundary_loops, fans, point_components
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.triangles.normals import area_vectors

LARGEST_LID = 0.25
"""Largest area of a lid as a share of its component's: the floor of a bust is closed, a bowl stays a bowl."""


class Lids(NamedTuple):
    """Triangles over small boundary loops.

    Attributes
    ----------
    points : (n + k, 3) float
        Those of the mesh, and the centres of all k loops.
    triangles : (t, 3) int
        Those of the lids alone.
    number : int
        Of lids.
    """

    points: Floats
    triangles: Indices
    number: int


def lids(mesh: PolygonMesh) -> Lids:
    """Return a fan of triangles for every boundary loop of a triangle mesh that is small, seen from its component.

    The fan joins the loop's edges to the mean of their ends. It may cross the surface: wrapping takes triangles
    as they are.
    """
    edges = Edges.of(mesh)
    rim, loop = boundary_loops(mesh, edges, fans(mesh, edges))
    count = int(loop.max(initial=-1)) + 1
    ends = mesh.corners[np.column_stack([rim, mesh.next_corner[rim]])]
    sums = [np.bincount(loop, values, minlength=count) for values in mesh.points[ends].sum(axis=1).T]
    centres = np.column_stack(sums) / (2 * np.bincount(loop, minlength=count))[:, None]
    points = np.concatenate([mesh.points, centres])
    triangles = np.column_stack([ends[:, ::-1], len(mesh.points) + loop])
    label = point_components(mesh, edges)
    whole = _areas(points, mesh.corners.reshape(-1, 3), label[mesh.corners[::3]], int(label.max()) + 1)
    small = _areas(points, triangles, loop, count)[loop] <= LARGEST_LID * whole[label[ends[:, 0]]]
    return Lids(points, triangles[small], len(np.unique(loop[small])))


def _areas(points: Floats, triangles: Indices, group: Indices, count: int) -> Floats:
    """Return the area of each group of triangles, (count,) float."""
    areas = np.linalg.norm(area_vectors(points, triangles), axis=1) / 2
    return np.asarray(np.bincount(group, areas, minlength=count), dtype=np.float64)
