"""A tube round a closed path: rings of points that turn with it as little as possible, joined to one closed surface."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.solid.part import Part
from fabricate.solid.wire_path import WirePath
from fabricate.triangles.normals import unit

FEWEST_SIDES = 12
"""Sides of a ring, however coarse the tolerance."""


def tube(path: WirePath, *, radius: float, tolerance: float, name: str) -> Part:
    """Return a tube as one solid of genus 1; the radius and the chord error round it are in mm.

    The sides of a ring touch the circle from outside, so that the wire is not thinner than asked. Rings stand in the
    planes across the path, by rotation-minimising frames. What is left of a turn when the last ring meets the first
    again is taken up by a shift of whole sides, and its remainder is spread along the path.
    """
    sides = max(int(np.ceil(np.pi / np.arccos(radius / (radius + tolerance)))), FEWEST_SIDES)
    normals, turned, closing = _frames(path)
    side = 2.0 * np.pi / sides
    shift = round(closing / side)
    passed = np.concatenate([[0.0], np.cumsum(path.steps)[:-1]]) / path.length
    angles = (turned - passed * (closing - shift * side))[:, None] + side * np.arange(sides)
    binormals = np.cross(path.tangents, normals)
    across = np.cos(angles)[:, :, None] * normals[:, None] + np.sin(angles)[:, :, None] * binormals[:, None]
    points = path.points[:, None] + radius / np.cos(0.5 * side) * across
    return Part(name, points.reshape(-1, 3), _triangles(len(points), sides, shift))


def _frames(path: WirePath) -> tuple[Floats, Floats, float]:
    """Return unit normals of the path, how far its rotation-minimising frame is turned from each, and the rest.

    The normals, (n, 3), may be any; the angles, (n,), from normal towards tangent x normal, are what makes a frame of
    them that turns as little as possible: each step is carried to the next place by double reflection (W. Wang,
    B. Juettler, D. Zheng, Y. Liu, "Computation of rotation minimizing frames", ACM Transactions on Graphics 27, 2008)
    and compared with the normal there, so that the angles of all steps need only be summed. The rest is by how much
    the frame has turned when it comes back to the first place.
    """
    tangents = path.tangents
    axes = np.eye(3)[np.abs(tangents).argmin(axis=1)]
    normals = unit(axes - np.einsum("ij,ij->i", axes, tangents)[:, None] * tangents)
    way, ahead = np.roll(path.points, -1, axis=0) - path.points, np.roll(tangents, -1, axis=0)
    mirrored = _reflected(tangents, way)
    carried = _reflected(_reflected(normals, way), ahead - mirrored)
    there = np.roll(normals, -1, axis=0)
    binormal = np.cross(ahead, there)
    steps = np.arctan2(np.einsum("ij,ij->i", carried, binormal), np.einsum("ij,ij->i", carried, there))
    sums = np.cumsum(steps)
    closing = float(np.arctan2(np.sin(sums[-1]), np.cos(sums[-1])))
    return normals, np.concatenate([[0.0], sums[:-1]]), closing


def _reflected(vectors: Floats, across: Floats) -> Floats:
    """Return vectors, (n, 3), mirrored at the planes perpendicular to others, (n, 3)."""
    share = np.einsum("ij,ij->i", vectors, across) / np.einsum("ij,ij->i", across, across)
    mirrored: Floats = vectors - 2.0 * share[:, None] * across
    return mirrored


def _triangles(rings: int, sides: int, shift: int) -> Indices:
    """Return the triangles between each ring and the next, the last one's sides shifted; outward."""
    numbers = np.arange(rings * sides).reshape(rings, sides)
    following = np.concatenate([numbers[1:], np.roll(numbers[:1], -shift, axis=1)])
    a, b, c, d = numbers, np.roll(numbers, -1, axis=1), np.roll(following, -1, axis=1), following
    return np.concatenate([np.stack(corners, axis=2).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))])
