"""Contacts: where walls of one part face walls of another, how far apart, and the point that stays when one turns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.checks.gap import Spacing
from fabricate.triangles.normals import area_vectors, unit
from fabricate.triangles.search_tree import SearchTree

REACH = 1.5
"""Walls that face each other at a distance of up to this many clearances are contacts."""

CORNER_REACH = 2.0
"""The same for the corners of their triangles: where walls meet, the nearest place is another wall's."""

FACING = 0.8
"""Least cosine of the way to the nearest place with a wall's normal, and with the other wall's reversed."""

MOST_SAMPLES = 20_000
"""Contacts are looked for at no more places of each part."""

TOUCHING = 1e-4
"""Faces that are no farther apart than this, mm, are shared; float32 coordinates of large parts are as coarse."""

SAMPLES = np.array([[4, 4, 4], [8, 2, 2], [2, 8, 2], [2, 2, 8]]) / 12
"""Barycentric coordinates of the places on each triangle."""


class Contacts(NamedTuple):
    """Places where the first part faces the second.

    Attributes
    ----------
    points : (k, 3) float
        On the first part, mm.
    normals : (k, 3) float
        Unit vectors towards the second part.
    gaps : (k,) float
        Distance along the normal, mm.
    """

    points: Floats
    normals: Floats
    gaps: Floats


@dataclass(frozen=True, eq=False)
class Facing:
    """Which triangles of a part face another part about a clearance away; looked at when they are asked for.

    With a clearance of 0 such triangles are those whose corners all lie on the other part.

    Attributes
    ----------
    own, other : SearchTree
        Of the part, and of the other one.
    near : (m,) bool
        The triangles of which all corners are near enough to the other part: no others face it.
    clearance : float
        mm.
    """

    own: SearchTree
    other: SearchTree
    near: Mask
    clearance: float

    @classmethod
    def between(cls, own: SearchTree, other: SearchTree, distances: Floats, *, clearance: float) -> Facing:
        """Begin with the `distances`, (n,), of the part's points from the other, mm."""
        near: Mask = np.all(distances[own.triangles] <= CORNER_REACH * clearance, axis=1)
        return cls(own, other, near, clearance)

    def among(self, triangles: Indices) -> Mask:
        """Tell which of some triangles, (k,) int, face the other part, (k,) bool."""
        facing = self.near[triangles]
        if self.clearance > 0.0:
            near = triangles[facing]
            middles = self.own.points[self.own.triangles[near]].mean(axis=1)
            facing[facing] = _face_to_face(self.own, self.other, middles, near, self.clearance)[0]
        return facing


def contacts(spacing: Spacing, *, clearance: float) -> Contacts:
    """Find where the walls of two parts face each other, from the triangles of both."""
    own = _facing(spacing.first, spacing.second, spacing.to_second, clearance)
    other = _facing(spacing.second, spacing.first, spacing.to_first, clearance)
    return Contacts(
        np.concatenate([own.points, other.points + other.gaps[:, None] * other.normals]),
        np.concatenate([own.normals, -other.normals]),
        np.concatenate([own.gaps, other.gaps]),
    )


def shared_area(spacing: Spacing) -> float:
    """Return the area of the first part's surface that lies on that of the second, mm2, from places on its triangles.

    Parts that overlap, or touch at points and edges only, share none.
    """
    own, other = spacing.first, spacing.second
    corners = own.points[own.triangles]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    near = np.flatnonzero((spacing.to_second[own.triangles] <= longest[:, None] + TOUCHING).any(axis=1))
    if not len(near):
        return 0.0
    points, triangle = _samples(own, near)
    found = other.nearest(points)
    opposite = np.einsum("ij,ij->i", _normals(own, triangle), _normals(other, found.triangle)) <= -FACING
    shared = (found.distance <= TOUCHING) & opposite
    area = 0.5 * np.linalg.norm(area_vectors(own.points, own.triangles[triangle]), axis=1)
    every = len(SAMPLES) * len(near) / len(points)
    return float(area[shared].sum() * every / len(SAMPLES))


def joint_pivot(met: Contacts, centroid: Floats) -> Floats:
    """Return the point with the least sum of squared distances from the lines along the contacts' normals.

    Where all the normals are parallel it stays as far from the walls as the centroid is.
    """
    if not len(met.gaps):
        return centroid
    across = np.eye(3) - met.normals[:, :, None] * met.normals[:, None, :]
    offset = np.einsum("kij,kj->i", across, met.points - centroid)
    pivot: Floats = centroid + np.linalg.lstsq(across.sum(axis=0), offset, rcond=1e-2)[0]
    return pivot


def _facing(own: SearchTree, other: SearchTree, distances: Floats, clearance: float) -> Contacts:
    """Return the places of `own` whose walls face a wall of `other`."""
    triangles = own.triangles
    near = np.flatnonzero((distances[triangles] <= CORNER_REACH * clearance).all(axis=1))
    points, triangle = _samples(own, near)
    facing, gaps = _face_to_face(own, other, points, triangle, clearance)
    normals = _normals(own, triangle[facing])
    return Contacts(points[facing], normals, gaps[facing])


def _face_to_face(
    own: SearchTree, other: SearchTree, points: Floats, triangle: Indices, clearance: float
) -> tuple[Mask, Floats]:
    """Return which places on triangles of `own` face a wall of `other`, and how far it is along the normal, mm."""
    found = other.nearest(points)
    normals, opposite = _normals(own, triangle), _normals(other, found.triangle)
    way = found.point - points
    gaps = np.einsum("ij,ij->i", way, normals)
    facing = (
        (found.distance <= REACH * clearance)
        & (gaps >= FACING * found.distance)
        & (-np.einsum("ij,ij->i", way, opposite) >= FACING * found.distance)
    )
    return facing, gaps


def _normals(tree: SearchTree, triangles: Indices) -> Floats:
    return unit(area_vectors(tree.points, tree.triangles[triangles]))


def _samples(tree: SearchTree, triangles: Indices) -> tuple[Floats, Indices]:
    """Return places on the given triangles, (k, 3), evenly thinned out, and the triangle of each."""
    count = len(SAMPLES) * len(triangles)
    chosen = np.arange(0, count, max(1, -(-count // MOST_SAMPLES)))
    triangle, sample = triangles[chosen // len(SAMPLES)], chosen % len(SAMPLES)
    points = np.einsum("ki,kij->kj", SAMPLES[sample], tree.points[tree.triangles[triangle]])
    return points, triangle
