"""Points that coincide exactly."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.formats.welding import welded
from fabricate.mesh.polygon_mesh import PolygonMesh


def place_numbers(points: Floats) -> Indices:
    """Return the number of the place that each point is at, (n,) int, in the order in which they first appear.

    -0 equals 0, and a coordinate that is not a number equals nothing.
    """
    every_point_once = PolygonMesh(points, np.arange(len(points)), np.array([0, len(points)]))
    return welded(every_point_once).corners
