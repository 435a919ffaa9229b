"""Room: the places of a part that are farthest from the curve, where something can be set without cutting a neck."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import KDTree

from fabricate.arrays import Floats, Indices, Mask
from fabricate.surface.cut import CutSurface
from fabricate.triangles.adjacency import undirected_edges


@dataclass(frozen=True, eq=False)
class Places:
    """Places on the surface in the middle of where a region is wide.

    Attributes
    ----------
    points, normals : (k, 3) float
        Where they are, mm, and the surface's outward normals there.
    room : (k,) float
        How far the nearest curve is, mm.
    part : (k,) int
        Number of the part that each is on, that is of its region.
    """

    points: Floats
    normals: Floats
    room: Floats
    part: Indices

    def chosen(self, which: Indices | Mask) -> Places:
        """Return some of the places, in the order given."""
        return Places(self.points[which], self.normals[which], self.room[which], self.part[which])


def roomy_places(surface: CutSurface) -> Places:
    """Return the points of the surface that are farther from all curves than all their neighbours.

    They are the middles of the point discs at tile corners, and some along corridors.
    """
    on_curves = surface.curves.ravel()
    room: Floats = np.asarray(KDTree(surface.points[on_curves]).query(surface.points)[0])
    ends = undirected_edges(surface.triangles)
    farthest = np.ones(len(room), dtype=bool)
    first, second = room[ends].T
    farthest[ends[first < second, 0]] = False
    farthest[ends[second < first, 1]] = False
    farthest[on_curves] = False
    part = np.zeros(len(room), dtype=np.int64)
    part[surface.triangles] = surface.regions[:, None]
    return Places(surface.points[farthest], surface.normals[farthest], room[farthest], part[farthest])
