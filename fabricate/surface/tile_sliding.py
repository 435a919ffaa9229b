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
    way = along_surface(quads, means @ quads.points - quads.points)
    return replace(quads, points=quads.points + STEP * moving[:, None] * way)


def along_surface(quads: QuadMesh, ways: Floats) -> Floats:
    """Return the share of ways, (n, 3), within the surface at each point: along creases on these, none at corners."""
    normals = _control_normals(quads)
    flat: Floats = ways - np.einsum("ij,ij->i", ways, normals)[:, None] * normals
    if not quads.creases.any():
        return flat
    along = _crease_tangents(quads)
    kept = np.einsum("ij,ij->i", ways, along)[:, None] * along
    slides: Floats = np.where(quads.crease_counts[:, None] == 0, flat, kept)
    return slides


def _crease_tangents(quads: QuadMesh) -> Floats:
    """Return the unit tangent of the crease through each point, (n, 3); zero off creases and at their ends."""
    tail, head = quads.tiles.ravel()[quads.creases], np.roll(quads.tiles, -1, axis=1).ravel()[quads.creases]
    through = np.flatnonzero(quads.crease_counts == 2)
    ends = head[np.argsort(tail, kind="stable")][np.isin(np.sort(tail), through)].reshape(-1, 2)
    tangents = np.zeros_like(quads.points)
    tangents[through] = unit(quads.points[ends[:, 1]] - quads.points[ends[:, 0]])
    return tangents


def _control_normals(quads: QuadMesh) -> Floats:
    """Return unit normals of the control mesh at its points, (n, 3) float."""
    corners = quads.points[quads.tiles]
    facet = np.repeat(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]), 4, axis=0)
    columns = [np.bincount(quads.tiles.ravel(), axis, minlength=len(quads.points)) for axis in facet.T]
    return unit(np.stack(columns, axis=1))
