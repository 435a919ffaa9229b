"""A picture projected through a body."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import map_coordinates

from fabricate.arrays import Floats
from fabricate.triangles.normals import unit


def projected(luminance: Floats, places: Floats, *, axis: Floats) -> Floats:
    """Return the luminance that a picture has at places, (t,) float, when seen from the end of an axis.

    The picture covers the places just so, its middle on theirs, as large as need be and not distorted; z is up in it,
    or y if z is the axis. Between the middles of pixels luminance is linear.

    Parameters
    ----------
    luminance : (height, width) float
        The top row first.
    places : (t, 3) float
        mm.
    axis : (3,) float
        From the body towards the eye, of any length but zero.
    """
    across, up = _screen(axis)
    x, y = places @ across, places @ up
    height, width = luminance.shape
    wide, high = max(float(np.ptp(x)), np.finfo(float).tiny), max(float(np.ptp(y)), np.finfo(float).tiny)
    pixels = min(width / wide, height / high)
    rows = height / 2.0 - (y - (y.min() + y.max()) / 2.0) * pixels
    columns = width / 2.0 + (x - (x.min() + x.max()) / 2.0) * pixels
    seen: Floats = map_coordinates(luminance, (rows - 0.5, columns - 0.5), order=1, mode="nearest")
    return seen


def _screen(axis: Floats) -> tuple[Floats, Floats]:
    """Return the unit vectors that point right and up for an eye at the end of an axis."""
    towards = unit(np.reshape(axis, (1, 3)).astype(np.float64))[0]
    upright = np.array([0.0, 0.0, 1.0])
    if np.linalg.norm(np.cross(upright, towards)) < 1e-6:
        upright = np.array([0.0, 1.0, 0.0])
    across = unit(np.cross(upright, towards)[None, :])[0]
    return across, np.cross(towards, across)
