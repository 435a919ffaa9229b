"""Distances to the surface of a part, with its search tree built once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import igl
import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.solid.part import Part


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
    """A part, and the tree in which its triangles are looked up by place."""

    part: Part
    tree: igl.AABB

    @classmethod
    def of(cls, part: Part) -> SearchTree:
        """Build the tree of a part that has triangles."""
        tree = igl.AABB()
        tree.init(part.points, part.triangles)
        return cls(part, tree)

    def nearest(self, queries: Floats) -> Nearest:
        """Return the nearest place on the part to each of the points `queries`, (q, 3), mm."""
        squared, triangle, point = self.tree.squared_distance(
            self.part.points, self.part.triangles, np.ascontiguousarray(queries)
        )
        return Nearest(np.sqrt(squared).reshape(-1), np.reshape(triangle, -1), np.reshape(point, (-1, 3)))
