"""Lips: what is left of the part with the groove between the sides of the groove and the faces above and below it.

A lip with a sharp edge is no wall, one with a blunt edge is. Sides that are flat enough on average may be steeper in
places, where the curve bends and neighbouring points move aside at different slants. So triangles are measured.
"""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.solid.layers import wall
from fabricate.triangles.normals import area_vectors, unit


def lip_steepness(walls: Floats, above: Floats, below: Floats) -> Floats:
    """Return how steep the sides of a groove are beside each curve point, (c,): the sine of their angle to the wall.

    Parameters
    ----------
    walls : (l, c, 3) float
        Copies of the curve on the wall of the part with the groove, on the curve's right, from the outside in.
    above, below : (c, 3) float, unit
        Normals of the faces at the wall's upper and lower edge, out of the part.
    """
    middle = len(walls) // 2
    count = walls.shape[1]
    steepest = np.zeros(count)
    for level in range(len(walls) - 1):
        facing = above if level < middle else below
        for triangles in np.split(wall(np.arange(count), (level + 1) * count, level * count), 2):
            steep = _against(walls.reshape(-1, 3), triangles, facing)
            steepest = np.maximum.reduce([steepest, steep, np.roll(steep, 1)])
    return steepest


def _against(points: Floats, triangles: Indices, facing: Floats) -> Floats:
    """Return the larger cosine between triangles and the normals at either end, (c, 3), of the cell that each is in."""
    normals = unit(area_vectors(points, triangles))
    cosines = [np.einsum("ij,ij->i", normals, each) for each in (facing, np.roll(facing, -1, axis=0))]
    larger: Floats = np.maximum(*cosines)
    return larger
