"""How thick a closed mesh is, measured by rays straight inward."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.prepare.unit_box import UnitBox
from fabricate.triangles.normals import area_vectors, unit
from fabricate.triangles.ray_casting import first_hits

MOST_RAYS = 200_000
"""Of a mesh with more triangles, only every second, third ... one sends a ray."""

START = 1e-6
"""How far under its triangle a ray begins, as a share of the diagonal: single precision asks for that much."""

OPPOSITE = -0.8
"""Two faces are opposite sides when the cosine between their normals is less."""


class Thinnest(NamedTuple):
    """The smallest distance from a triangle's middle straight inward to an opposite face, and where that begins."""

    thickness: float
    place: Floats


def thinnest_place(points: Floats, triangles: Indices) -> Thinnest | None:
    """Return where a closed surface is thinnest, in the points' unit, or None if no two faces are opposite.

    Near a sharp edge, where the first face met is inclined to the one that the ray starts from, nothing is measured.

    Parameters
    ----------
    points : (n, 3) float
    triangles : (t, 3) int
        Facing outward.
    """
    found = thicknesses(points, triangles)
    first = int(found.argmin()) if len(found) else -1
    if first < 0 or not np.isfinite(found[first]):
        return None
    return Thinnest(float(found[first]), points[triangles[first]].mean(axis=0))


def thicknesses(points: Floats, triangles: Indices) -> Floats:
    """Return the distance from each triangle's middle straight inward to an opposite face, (t,) float.

    It is infinite where there is none, and where no ray was sent, as from triangles without area.

    Parameters
    ----------
    points : (n, 3) float
    triangles : (t, 3) int
        Facing outward.
    """
    box = UnitBox.of(points)
    placed = box.placed(points)
    normals = unit(area_vectors(placed, triangles))
    sending = np.flatnonzero(normals.any(axis=1))
    sending = sending[:: max(1, -(-len(sending) // MOST_RAYS))]
    middles, inward = placed[triangles[sending]].mean(axis=1), -normals[sending]
    hits = first_hits(placed, triangles, middles + START * inward, inward)
    cosines = np.einsum("ij,ij->i", normals[sending], normals[hits.triangle])
    opposite = (hits.triangle >= 0) & (cosines < OPPOSITE)
    found = np.full(len(triangles), np.inf)
    found[sending] = np.where(opposite, hits.distance + START, np.inf) * box.diagonal * box.unit
    return found
