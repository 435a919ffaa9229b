"""A part with a corner almost in the place where a bar has one: exact triangles between them are lost in rounding."""

from __future__ import annotations

import numpy as np

from fabricate.solid.booleans import Cylinder, bar
from fabricate.solid.part import Part

MIDDLE = np.array([50.0, 50.0, 0.0])
"""Where the bar's axis is, mm: there float32 cannot tell 0.000001 mm apart."""

UP = np.array([0.0, 0.0, 1.0])


def bar_at_corner(*, radius: float, tolerance: float) -> tuple[Part, Cylinder]:
    """Return a double pyramid called "yellow", and an upright bar with an edge through its lower tip."""
    upright = Cylinder(MIDDLE - 6.0 * UP, MIDDLE + 3.0 * UP, radius)
    corners = np.asarray(bar(upright, tolerance=tolerance).to_mesh64().vert_properties)[:, :3]
    tip = [*corners[corners[:, 0].argmax(), :2], -5.0]
    points = np.array([tip, *(MIDDLE + 9.0 * np.array([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1]]))])
    ring = [(1, 2), (2, 3), (3, 4), (4, 1)]
    return Part("yellow", points, np.array([(0, b, a) for a, b in ring] + [(5, a, b) for a, b in ring])), upright
