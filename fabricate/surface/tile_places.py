"""Where tiles lie on the limit surface, and which way they face."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, frozen
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.limit import limit_vertices
from fabricate.triangles.normals import unit


@dataclass(frozen=True, eq=False)
class TilePlaces:
    """Each tile as a flat square, from the limit positions of its corners.

    Attributes
    ----------
    corners : (t, 4, 3) float
        On the limit surface, mm.
    middle : (t, 3) float
        Mean of the corners, mm.
    normal : (t, 3) float
        Unit outward normal: across both diagonals.
    """

    corners: Floats
    middle: Floats
    normal: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "corners", frozen(self.corners, np.float64, (None, 4, 3)))
        object.__setattr__(self, "middle", frozen(self.middle, np.float64, (len(self.corners), 3)))
        object.__setattr__(self, "normal", frozen(self.normal, np.float64, (len(self.corners), 3)))

    @classmethod
    def of(cls, quads: QuadMesh) -> TilePlaces:
        """Return the places of all tiles."""
        corners = limit_vertices(quads)[quads.tiles]
        normal = unit(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]))
        middle = corners.mean(axis=1)
        for each in (corners, middle, normal):
            each.flags.writeable = False  # so that no copy is made of it
        return cls(corners, middle, normal)

    @property
    def centre(self) -> Floats:
        """(3,) float: the middle of the box round all corners, mm."""
        corners = self.corners.reshape(-1, 3)
        middle: Floats = (corners.min(axis=0) + corners.max(axis=0)) / 2.0
        return middle
