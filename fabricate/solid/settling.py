"""Settling: tiles too small for the clearance grow at the cost of the larger ones around them.

A cage's smallest faces, at an eye or a nostril, can be hardly wider than the gap, and no way of moving the curve makes
room there. The control points of such tiles slide, within the surface's tangent plane, towards the mean of their
neighbours until the clearance fits. The surface stays a smooth Catmull-Clark limit, and everything but the
neighbourhood of such tiles stays where it was.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.sparse import coo_array

from fabricate.arrays import Floats, Mask
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.errors import SolidError
from fabricate.solid.clearance import check_necks, clearance_shares, ray_sides, too_near
from fabricate.surface.cut import CutSurface, cut
from fabricate.surface.limit import LimitSurface
from fabricate.surface.resolution import resolution_for
from fabricate.triangles.normals import unit

ENOUGH = 0.99
"""Share of the clearance that copies of the curve must be apart."""

BENEATH = 0.08
"""The clearance must fit on the surface and this far below it, mm: a wall is at least as thick."""

MOST_TIGHT = 0.1
"""With a larger share of tight tiles there is no room to take from."""

ROUNDS, PATIENCE, STEP = 40, 4, 0.25
"""Rounds of measuring and sliding, rounds without progress before giving up, and the share of the way to the mean
that points move in each."""


def fitted_cut(duotone: Duotone, *, arc: float = 0.5, tolerance: float = 0.05, clearance: float = 0.0) -> CutSurface:
    """Cut the limit surface of a duotone as finely as `tolerance` asks for, with room for `clearance`; both mm.

    `arc` is where the curve crosses tile sides, from their yellow ends, between 0.293 and 0.707.

    Raises
    ------
    PatternError
        If the arc position is out of range, the tolerance would need too many triangles, or the duotone has
        more than one curve.
    SolidError
        If the clearance is as wide as necks are, or does not fit into more than a tenth of the tiles.
    """
    resolution = resolution_for(duotone, LimitSurface.of(duotone.quads), arc=arc, tolerance=tolerance)
    return settled(duotone, clearance=clearance, arc=arc, resolution=resolution)


def settled(duotone: Duotone, *, clearance: float, arc: float, resolution: int) -> CutSurface:
    """Return the cut surface of the duotone, its tiles slid where the clearance, mm, does not fit."""
    quads = duotone.quads
    surface = cut(duotone, LimitSurface.of(quads), arc=arc, resolution=resolution)
    check_necks(surface, clearance=clearance)
    fewest, waited = len(duotone.joined) + 1, 0
    for _ in range(ROUNDS if clearance > 0.0 else 0):
        tight = tight_tiles(surface, clearance=clearance)
        if tight.mean() > MOST_TIGHT:
            raise SolidError(
                f"a clearance of {clearance:g} mm does not fit into {int(tight.sum())} of {len(tight)} tiles; "
                "ask for a smaller solid.clearance, or divide a mesh with larger faces"
            )
        fewest, waited = min(fewest, int(tight.sum())), waited + 1 if tight.sum() >= fewest else 0
        if not tight.any() or waited == PATIENCE:
            break
        quads = _slid(quads, tight)
        surface = cut(replace(duotone, quads=quads), LimitSurface.of(quads), arc=arc, resolution=resolution)
    return surface


def tight_tiles(surface: CutSurface, *, clearance: float) -> Mask:
    """Return the tiles, (t,) bool, in which copies of the curve cannot be moved `clearance` mm apart."""
    count = len(surface.curve)
    upright = surface.normals[surface.curve]
    wanted, everywhere = np.full(count, clearance), np.arange(count)
    near: Mask = np.zeros(count, dtype=bool)
    for depth in (0.0, BENEATH):
        sides = ray_sides(surface, surface.points - depth * surface.normals)
        shares = clearance_shares(sides, upright, -upright, clearance=wanted)
        near |= too_near(sides, shares, ENOUGH * wanted, suspects=everywhere)
    tight: Mask = np.zeros(len(surface.order) // 2, dtype=bool)
    tight[surface.order[near.reshape(len(surface.order), -1).any(axis=1)] // 2] = True
    return tight


def _slid(quads: QuadMesh, tight: Mask) -> QuadMesh:
    """Move the control points of the tight tiles and their neighbours within their tangent planes.

    Those on creases move along these; corners and darts stay.
    """
    tail = quads.tiles.ravel()
    head = np.roll(quads.tiles, -1, axis=1).ravel()
    count = len(quads.points)
    valence = np.bincount(tail, minlength=count)
    means = coo_array((1.0 / valence[tail], (tail, head)), shape=(count, count)).tocsr()
    moving: Mask = np.zeros(count, dtype=bool)
    moving[quads.tiles[tight]] = True
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
