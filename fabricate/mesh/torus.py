"""Grids of quads that close in both directions: the ring torus, and the cage of any other closed tube."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats
from fabricate.errors import MeshError
from fabricate.mesh.polygon_mesh import PolygonMesh


def torus(*, around: int, across: int, tube: float) -> PolygonMesh:
    """Return a torus of quads about the z axis whose Catmull-Clark limit has ring radius 1.

    Parameters
    ----------
    around, across : int
        Number of quads along the ring and round the tube.
    tube : float
        Radius of the tube on the limit surface, as a fraction of the ring's radius.

    Raises
    ------
    MeshError
        If a count is below 3, or the tube is not above 0, or so thick that the cage has no hole.
    """
    if min(around, across) < 3:
        raise MeshError(f"torus: around and across must be 3 or more, found {around} and {across}: ask for more quads")
    turn, roll = (np.arange(count) * (2 * np.pi / count) for count in (around, across))
    thickest = -limit_radius(across) / np.cos(roll).min()
    if not 0 < tube < thickest:
        raise MeshError(
            f"torus: tube must be above 0 and below {thickest:.3f} with {across} quads across, "
            f"found {tube:g}: change it, or ask for more quads across"
        )
    outward = np.stack([np.cos(turn), np.sin(turn), np.zeros(around)], axis=1)
    limit = outward[:, None] * (1 + tube * np.cos(roll))[:, None]
    limit[..., 2] = tube * np.sin(roll)
    return tube_cage(limit)


def tube_cage(limit: Floats) -> PolygonMesh:
    """Return the quads, closed in both directions, whose Catmull-Clark limit passes through given points.

    On a grid of quads the limit is a bicubic B-spline. Interpolation with closed uniform splines is a
    circulant system in each direction, which Fourier transforms turn into a division.

    Parameters
    ----------
    limit : (n, m, 3) float
        Where the limit surface has to be, for n points along the tube and m round it, 3 or more each.
        The cross product of a step along and a step round points outward.

    Returns
    -------
    PolygonMesh
        n m points in the order given, n m quads.
    """
    along, across, _ = limit.shape
    response = np.multiply.outer(_spline_response(along), _spline_response(across))
    points = np.fft.ifft2(np.fft.fft2(limit, axes=(0, 1)) / response[..., None], axes=(0, 1)).real
    number = np.arange(along * across).reshape(along, across)
    ahead, beside = np.roll(number, -1, axis=0), np.roll(number, -1, axis=1)
    quads = np.stack([number, ahead, np.roll(ahead, -1, axis=1), beside], axis=-1)
    return PolygonMesh(points.reshape(-1, 3), quads.ravel(), np.arange(0, quads.size + 1, 4))


def limit_radius(count: int) -> float:
    """Return the distance from the centre at which a closed cubic B-spline passes its control points.

    These are the corners of a regular polygon with `count` corners at distance 1 from its centre.
    """
    return float(_spline_response(count)[1])


def _spline_response(count: int) -> Floats:
    """Return the factors by which the limit mask (1, 4, 1) / 6 damps the frequencies of a closed polygon."""
    response: Floats = (2 + np.cos(np.arange(count) * (2 * np.pi / count))) / 3
    return response
