"""Tiles that slide over the surface: small ones grow at the cost of the larger ones around them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.sparse import coo_array

from fabricate.arrays import Floats, Mask
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.triangles.normals import unit

STEP = 0.25
"""Share of the way to the mean of their neighbours that points move."""


def slid_tiles(quads: QuadMesh, chosen: Mask) -> QuadMesh:
    """Return the quads with the points of the chosen tiles, (t,) bool, and their neighbours slid in tangent planes.

    Those on creases move along these; corners and darts stay.
    """
    tail = quads.tiles.ravel()
    head = np.roll(quads.tiles, -1, axis=1).ravel()
    count = len(quads.points)
    valence = np.bincount(tail, minlength=count)
    means = coo_array((1.0 / valence[tail], (tail, head)), shape=(count, count)).tocsr()
    moving: Mask = np.zeros(count, dtype=bool)
    moving[quads.tiles[chosen]] = True
    moving |= means @ moving.astype(np.float64) > 0.0
    way = means @ quads.points - quads.points
    normals = _control_normals(quads)
    way -= np.einsum("ij,ij->i", way, normals)[:, None] * normals
    if quads.creases.any():
        way = np.where(quads.crease_counts[:, None] == 0, way, _ways_along_creases(quads))
    return replace(quads, points=quads.points + STEP * moving[:, None] * way)


def _ways_along_creases(quads: QuadMesh) -> Floats:
    """Return the way of each point on a crease along it, to beside the mean of its two neighbours there, (n, 3)."""
    count = len(quads.points)
    tail, head = quads.tiles.ravel()[quads.creases], np.roll(quads.tiles, -1, axis=1).ravel()[quads.creases]
    through = np.flatnonzero(quads.crease_counts == 2)
    ends = head[np.argsort(tail, kind="stable")][np.isin(np.sort(tail), through)].reshape(-1, 2)
    first, second = quads.points[ends[:, 0]], quads.points[ends[:, 1]]
    along = unit(second - first)
    to_mean = 0.5 * (first + second) - quads.points[through]
    ways = np.zeros((count, 3))
    ways[through] = np.einsum("ij,ij->i", to_mean, along)[:, None] * along
    return ways


def _control_normals(quads: QuadMesh) -> Floats:
    """Return unit normals of the control mesh at its points, (n, 3) float."""
    corners = quads.points[quads.tiles]
    facet = np.repeat(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]), 4, axis=0)
    columns = [np.bincount(quads.tiles.ravel(), axis, minlength=len(quads.points)) for axis in facet.T]
    return unit(np.stack(columns, axis=1))
