"""A trefoil knot: a tube along the (2, 3) torus knot."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats
from fabricate.errors import MeshError
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.torus import limit_radius, tube_cage

_RING = 2.2  # ring radius over minor radius of the torus: near the ratio that lets the tube be thickest
_THICKEST = 0.85  # a round tube touches itself at 0.978; the rest is for the flat sides of a coarse cage


def trefoil(*, around: int, across: int, tube: float) -> PolygonMesh:
    """Return a tube of quads along the (2, 3) torus knot, the trefoil, about the z axis.

    The minor radius of the torus that the knot lies on is 1, its ring radius 2.2. Rings of quads follow
    each other at equal distances and are twisted only as far as closing the tube needs.

    Parameters
    ----------
    around, across : int
        Number of quads along the knot, 24 or more, and round the tube, 3 or more.
    tube : float
        Radius of the tube on the Catmull-Clark limit surface, as a fraction of the minor radius.

    Raises
    ------
    MeshError
        If a count is too small, or the tube is not above 0, or so thick that it might touch itself.
    """
    if around < 24 or across < 3:
        raise MeshError(
            f"knot: around must be 24 or more and across 3 or more, found {around} and {across}: ask for more quads"
        )
    thickest = _THICKEST * limit_radius(across)
    if not 0 < tube <= thickest:
        raise MeshError(
            f"knot: tube must be above 0 and at most {thickest:.3f} with {across} quads across, "
            f"found {tube:g}: change it, or ask for more quads across"
        )
    centres, tangents = _curve(_equidistant(around))
    normals = _closed_frame(centres, tangents)
    sideways = np.cross(normals, tangents)
    roll = np.arange(across)[:, None] * (2 * np.pi / across)
    spokes = np.cos(roll) * normals[:, None] + np.sin(roll) * sideways[:, None]
    return tube_cage(centres[:, None] + tube * spokes)


def _curve(parameters: Floats) -> tuple[Floats, Floats]:
    """Return (n, 3) points and unit tangents of the knot: twice about the z axis, 3 times round the ring."""
    turn, roll = 2 * parameters, 3 * parameters
    radial = np.stack([np.cos(turn), np.sin(turn), np.zeros_like(turn)], axis=1)
    circling = np.stack([-np.sin(turn), np.cos(turn), np.zeros_like(turn)], axis=1)
    distance = (_RING + np.cos(roll))[:, None]
    points = distance * radial
    points[:, 2] = np.sin(roll)
    velocity = 2 * distance * circling - 3 * np.sin(roll)[:, None] * radial
    velocity[:, 2] = 3 * np.cos(roll)
    return points, velocity / np.linalg.norm(velocity, axis=1, keepdims=True)


def _equidistant(count: int) -> Floats:
    """Return the curve parameters of `count` points at equal distances along the knot."""
    parameters = np.linspace(0, 2 * np.pi, 64 * count + 1)
    points, _ = _curve(parameters)
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    length = np.concatenate([[0.0], np.cumsum(steps)])
    equidistant: Floats = np.interp(np.arange(count) * (length[-1] / count), length, parameters)
    return equidistant


def _closed_frame(points: Floats, tangents: Floats) -> Floats:
    """Return (n, 3) unit normals that turn as little as possible along a closed curve and meet themselves.

    A rotation-minimising frame by double reflection; the angle by which it misses itself after one round
    is taken back evenly.

    References
    ----------
    W. Wang, B. Juettler, D. Zheng, Y. Liu, "Computation of rotation minimizing frames", ACM Transactions
    on Graphics 27(1), 2008.
    """
    start = np.cross([0.0, 0.0, 1.0], tangents[0])
    carried = [start / np.linalg.norm(start)]
    chords = np.roll(points, -1, axis=0) - points
    for chord, tangent, ahead in zip(chords, tangents, np.roll(tangents, -1, axis=0), strict=True):
        normal = _reflected(carried[-1], chord)
        carried.append(_reflected(normal, ahead - _reflected(tangent, chord)))
    normals, last = np.array(carried[:-1]), carried[-1]
    sideways = np.cross(tangents, normals)
    missed = np.arctan2(last @ sideways[0], last @ normals[0])
    angle = -missed / len(points) * np.arange(len(points))[:, None]
    closed: Floats = np.cos(angle) * normals + np.sin(angle) * sideways
    return closed


def _reflected(vector: Floats, normal: Floats) -> Floats:
    """Return the vector mirrored in the plane through the origin with this normal (of any length)."""
    return vector - normal * (2 * (normal @ vector) / (normal @ normal))
