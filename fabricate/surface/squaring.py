"""Squaring: points that slide over the surface to where the tiles around them are nearer to squares of given sides."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fabricate.arrays import Floats
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.tile_sliding import along_surface
from fabricate.triangles.normals import unit


def squared(quads: QuadMesh, *, sides: Floats, weights: Floats) -> QuadMesh:
    """Return the quads, each point moved to the mean of its places in the nearest squares of the tiles around it.

    Only the share of that move within the surface is made.

    Parameters
    ----------
    quads : QuadMesh
    sides : (t,) float
        Of each tile's square, mm.
    weights : (t,) float
        How much each tile counts for the points that it shares with others.

    References
    ----------
    S. Bouaziz, M. Deuss, Y. Schwartzburg, T. Weise, M. Pauly, "Shape-Up: Shaping discrete geometry with
    projections", Computer Graphics Forum 31(5), 2012: the means of projections; sides of our choice are ours.
    """
    corner = quads.tiles.ravel()
    places = nearest_squares(quads.points[quads.tiles], sides).reshape(-1, 3)
    of_corner = np.repeat(weights, 4)
    total = [np.bincount(corner, of_corner * axis, minlength=len(quads.points)) for axis in places.T]
    goals = np.stack(total, axis=1) / np.bincount(corner, of_corner, minlength=len(quads.points))[:, None]
    return replace(quads, points=quads.points + along_surface(quads, goals - quads.points))


def nearest_squares(corners: Floats, sides: Floats) -> Floats:
    """Return the corners, (t, 4, 3), of the squares with the given sides, (t,), that are nearest to quads, (t, 4, 3).

    They lie in the planes that both diagonals are parallel to.
    """
    first, second = corners[:, 0] - corners[:, 2], corners[:, 1] - corners[:, 3]
    normal = unit(np.cross(first, second))
    half = np.sqrt(0.5) * sides[:, None] * unit(first - np.cross(normal, second))
    turned = np.cross(normal, half)
    squares: Floats = corners.mean(axis=1, keepdims=True) + np.stack([half, turned, -half, -turned], axis=1)
    return squares
