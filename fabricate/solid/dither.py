"""Dither: points of flat, slanting faces moved by a few nanometres, so that no two triangles lie in exactly one plane.

Programs that test triangles for crossings in floating point, as mesh viewers and slicers do, may take two that lie side
by side in exactly one slanting plane for crossing ones: the line in which the planes meet is then mere rounding. Out of
the plane by far less than anything that can be printed or measured, but by more than rounding, they are told apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.solid.assembly import Assembly
from fabricate.surface.embedding import stored
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.nearby import triangles_near
from fabricate.triangles.normals import area_vectors, unit

REACH = 1e-5
"""How far points move along each axis at most, mm: the coordinates of float32 at 100 mm are 0.76e-5 mm apart."""

IN_PLANE = 1e-8
"""How much less than 1 the cosine between normals may be in one plane: 0.008 degrees, which no curved surface has."""

FACE = 2
"""In a flat face a triangle has at least so many neighbours in its plane."""

_MIX = (0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB)
"""Odd constants of SplitMix64."""


def dithered(made: Assembly) -> Assembly:
    """Return the assembly with the points of flat faces that slant to all axes' planes moved by up to 0.00001 mm.

    The move depends on the number of a point alone, so shared faces stay the same to the last bit, and the same
    assembly gives the same points. Curved surfaces and faces in coordinate planes stay as they are, and so does
    everything if triangles would cross that did not.

    References
    ----------
    G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014: the mixing of
    bits.
    """
    chosen = np.zeros(len(made.points), dtype=bool)
    for triangles in made.bodies:
        chosen[triangles[_in_slanting_planes(made.points, triangles)]] = True
    if not chosen.any():
        return made
    moved = replace(made, points=stored(made.points + REACH * chosen[:, None] * _noise(len(made.points))))
    near = [body[triangles_near(made.points, body, chosen, reach=2.0 * REACH)] for body in made.bodies]
    crossing = _crossings(moved, near)
    return made if crossing and crossing > _crossings(made, near) else moved


def _in_slanting_planes(points: Floats, triangles: Indices) -> Mask:
    """Return the triangles, (m,) bool, of a closed mesh that lie in a slanting plane with most of their neighbours.

    The two triangles of a piece of wall lie in one plane as well, and are no face of it.
    """
    facets = unit(area_vectors(points, triangles))
    tails, heads = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    ahead, back = tails * len(points) + heads, heads * len(points) + tails
    order = np.argsort(ahead)
    across = order[np.searchsorted(ahead, back, sorter=order)] // 3
    cosine = np.einsum("ij,ij->i", facets[across], np.repeat(facets, 3, axis=0)).reshape(-1, 3)
    slanting = np.abs(facets).max(axis=1) < 1.0 - IN_PLANE
    in_planes: Mask = slanting & ((cosine > 1.0 - IN_PLANE).sum(axis=1) >= FACE)
    return in_planes


def _noise(count: int) -> Floats:
    """Return numbers between -1 and 1 that look random, (count, 3) float, each row depending on its number alone."""
    bits = np.arange(1, 3 * count + 1, dtype=np.uint64) * np.uint64(_MIX[0])
    bits = (bits ^ (bits >> np.uint64(30))) * np.uint64(_MIX[1])
    bits = (bits ^ (bits >> np.uint64(27))) * np.uint64(_MIX[2])
    noise: Floats = ((bits >> np.uint64(32)).astype(np.float64) / 2.0**31 - 1.0).reshape(count, 3)
    return noise


def _crossings(made: Assembly, near: Sequence[Indices]) -> int:
    """Return how many pairs of triangles cross among some of each body's, (k, 3) int."""
    return sum(len(crossing_triangles(made.points, triangles)) for triangles in near)
