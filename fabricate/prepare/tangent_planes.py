"""The planes of the triangles round a point, and the place that keeps nearest to all of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.prepare.triangle_mesh import TriangleMesh
from fabricate.triangles.normals import area_vectors, unit

HOLD = 0.02
"""Weight of the place asked for against all planes together: in a plane it decides alone, across one hardly.

With less of it corners and tips of a shape hold longer, and with more of it triangles become more even.
"""


@dataclass(frozen=True, eq=False)
class TangentPlanes:
    """Planes round each point of a mesh, weighted by area: x misses them by x A x - 2 b x + a constant.

    Attributes
    ----------
    quadratic : (n, 3, 3) float
        A, mm2.
    linear : (n, 3) float
        b, mm3.
    """

    quadratic: Floats
    linear: Floats

    @classmethod
    def of(cls, mesh: TriangleMesh) -> TangentPlanes:
        """Collect the planes of the triangles round each point."""
        vectors = area_vectors(mesh.points, mesh.triangles)
        normals = unit(vectors)
        weight = np.linalg.norm(vectors, axis=1)
        offset = np.einsum("ij,ij->i", normals, mesh.points[mesh.triangles[:, 0]])
        squares = (weight[:, None, None] * normals[:, :, None] * normals[:, None, :]).reshape(-1, 9)
        fans = mesh.fans
        return cls((fans @ squares).reshape(-1, 3, 3), fans @ ((weight * offset)[:, None] * normals))

    def nearest(self, points: Indices, goals: Floats) -> Floats:
        """Return for each row of points, (k, c), the place nearest to their planes that is near its goal, (k, 3).

        At a corner or on an edge of the shape that is a place on it, and elsewhere the goal within the plane.

        Source: Garland and Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997; the
        hold on the goal is ours.
        """
        quadratic, linear = self.quadratic[points].sum(axis=1), self.linear[points].sum(axis=1)
        pull = HOLD * np.trace(quadratic, axis1=1, axis2=2) + np.finfo(float).tiny
        matrix = quadratic + pull[:, None, None] * np.eye(3)
        places: Floats = np.linalg.solve(matrix, (linear + pull[:, None] * goals)[..., None])[..., 0]
        return places
