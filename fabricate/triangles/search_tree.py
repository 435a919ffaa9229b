"""Nearest places on a triangle mesh, with its search tree built once (libigl)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import igl
import numpy as np

from fabricate.arrays import Floats, Indices


class Nearest(NamedTuple):
    """The nearest place on a surface to each query point.

    Attributes
    ----------
    distance : (q,) float
        mm.
    triangle : (q,) int
        The triangle that it lies on.
    point : (q, 3) float
        mm.
    """

    distance: Floats
    triangle: Indices
    point: Floats


@dataclass(frozen=True, eq=False)
class SearchTree:
    """Triangles, (m, 3) int, on points, (n, 3) float mm, and the tree in which they are looked up by place."""

    points: Floats
    triangles: Indices
    tree: igl.AABB

    @classmethod
    def of(cls, points: Floats, triangles: Indices) -> SearchTree:
        """Build the tree of at least one triangle."""
        points, triangles = np.ascontiguousarray(points), np.ascontiguousarray(triangles)
        tree = igl.AABB()
        tree.init(points, triangles)
        return cls(points, triangles, tree)

    def nearest(self, queries: Floats) -> Nearest:
        """Return the nearest place on the mesh to each of the points `queries`, (q, 3), mm."""
        squared, triangle, point = self.tree.squared_distance(
            self.points, self.triangles, np.ascontiguousarray(queries)
        )
        return Nearest(np.sqrt(squared).reshape(-1), np.reshape(triangle, -1), np.reshape(point, (-1, 3)))
