"""The triangles that strips and fans of points stand for."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Indices


def strip_triangles(strip: Indices) -> Indices:
    """Return the (t, 3) triangles of strips, in which every point makes one with the two before it.

    Every second triangle is turned round, so that all have the winding of the first; those that name a point
    twice only lead the strip elsewhere, and are left out.

    Parameters
    ----------
    strip : (n,) int
        Points of all strips, with -1 between one strip and the next.
    """
    place = np.arange(len(strip))
    begins = np.maximum.accumulate(np.where(strip == -1, place + 1, 0))
    triangles = np.stack([strip[:-2], strip[1:-1], strip[2:]], axis=1)
    odd = ((place - begins)[:-2] % 2 == 1)[: len(triangles)]
    triangles[odd] = triangles[odd][:, [1, 0, 2]]
    return _real(triangles[(triangles != -1).all(axis=1)])


def fan_triangles(fan: Indices) -> Indices:
    """Return the (t, 3) triangles of a fan, in which every point makes one with the one before and the first."""
    rest = fan[1:]
    return _real(np.stack([np.broadcast_to(fan[:1], len(rest))[1:], rest[:-1], rest[1:]], axis=1))


def _real(triangles: Indices) -> Indices:
    a, b, c = triangles.T
    real: Indices = triangles[(a != b) & (b != c) & (c != a)]
    return real
