"""Values at the points of a mesh, carried over to places near it."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.formats.point_values import PointValues
from fabricate.prepare.triangle_mesh import fanned
from fabricate.triangles.search_tree import SearchTree


def nearest_values(known: PointValues, places: Floats) -> Floats:
    """Return the value at the nearest place of a mesh, (t,) float, for each of the places, (t, 3) float, mm.

    Values are linear in triangles; a larger polygon is a fan round the mean of its corners, which has their mean value.
    """
    surface = fanned(known.mesh)
    # the same fans on values in place of coordinates
    values = fanned(known.mesh.moved(np.repeat(known.values[:, None], 3, axis=1))).points[:, 0]
    found = SearchTree.of(surface.points, surface.triangles).nearest(places)
    corners = surface.triangles[found.triangle]
    carried: Floats = (_shares(surface.points, corners, found.point) * values[corners]).sum(axis=1)
    return carried


def _shares(points: Floats, corners: Indices, places: Floats) -> Floats:
    """Return barycentric coordinates of places in triangles, (t, 3) float; those without area have equal ones."""
    spokes = points[corners] - places[:, None, :]
    opposite = np.cross(np.roll(spokes, -1, axis=1), np.roll(spokes, -2, axis=1))
    area = np.linalg.norm(opposite, axis=2)
    total = area.sum(axis=1, keepdims=True)
    shares: Floats = np.where(total > 0.0, area / np.where(total > 0.0, total, 1.0), 1.0 / 3.0)
    return shares
