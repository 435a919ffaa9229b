"""Numbers that a mesh file has for its points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, frozen
from fabricate.mesh.polygon_mesh import PolygonMesh


@dataclass(frozen=True, eq=False)
class PointValues:
    """A mesh and one number for each of its points.

    Attributes
    ----------
    mesh : PolygonMesh
        As the file has it; not known to be closed.
    values : (n,) float
        In whatever unit the file means.
    """

    mesh: PolygonMesh
    values: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", frozen(self.values, np.float64, (len(self.mesh.points),)))

    def scaled(self, factor: float) -> PointValues:
        """Return the same values on the mesh with every coordinate multiplied by `factor`."""
        return PointValues(self.mesh.scaled(factor), self.values)
