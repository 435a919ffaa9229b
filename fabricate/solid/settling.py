"""Settling: tiles too small for the clearance grow at the cost of the larger ones around them.

A cage's smallest faces, at an eye or a nostril, can be hardly wider than the gap, and no way of moving the curve makes
room there. The control points of such tiles slide, within the surface's tangent plane, towards the mean of their
neighbours until the clearance fits. The surface stays a smooth Catmull-Clark limit, and everything but the
neighbourhood of such tiles stays where it was.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fabricate.arrays import Mask
from fabricate.duotone.duotone import Duotone
from fabricate.errors import SolidError
from fabricate.solid.clearance import check_necks, clearance_shares, moved_copies, ray_sides, too_near
from fabricate.surface.cut import CutSurface, cut
from fabricate.surface.limit import LimitSurface
from fabricate.surface.neck import tile_areas
from fabricate.surface.resolution import resolution_for
from fabricate.surface.tile_sliding import slid_tiles

ENOUGH = 0.99
"""Share of the clearance that copies of the curve must be apart."""

BENEATH = 0.08
"""The clearance must fit on the surface and this far below it, mm: a wall is at least as thick."""

MOST_TIGHT = 0.1
"""With tight tiles on a larger share of the surface there is no room to take from."""

ROUNDS, PATIENCE = 40, 4
"""Rounds of measuring and sliding, and rounds without progress before giving up."""


def fitted_cut(
    duotone: Duotone, *, rings: Sequence[float] = (0.5,), tolerance: float = 0.05, clearance: float = 0.0
) -> CutSurface:
    """Cut the limit surface of a duotone as finely as `tolerance` asks for, with room for `clearance`; both mm.

    `rings` says where curves cross tile sides, from their yellow ends, between 0.293 and 0.707: one position for a
    duotone, several that increase for a multitone, whose curves run side by side.

    Raises
    ------
    PatternError
        If the rings are out of range or do not increase, the tolerance would need too many triangles, or the duotone
        has more than one curve.
    SolidError
        If the clearance is as wide as necks are, or does not fit into the tiles on more than a tenth of the surface.
    """
    resolution = resolution_for(duotone, LimitSurface.of(duotone.quads), rings=rings, tolerance=tolerance)
    return settled(duotone, clearance=clearance, rings=rings, resolution=resolution)


def settled(duotone: Duotone, *, clearance: float, rings: Sequence[float], resolution: int) -> CutSurface:
    """Return the cut surface of the duotone, its tiles slid where the clearance, mm, does not fit."""
    quads = duotone.quads
    surface = cut(duotone, LimitSurface.of(quads), rings=rings, resolution=resolution)
    check_necks(surface, clearance=clearance)
    fewest, waited = len(duotone.joined) + 1, 0
    for _ in range(ROUNDS if clearance > 0.0 else 0):
        tight, areas = tight_tiles(surface, clearance=clearance), tile_areas(surface)
        if areas[tight].sum() > MOST_TIGHT * areas.sum():
            raise SolidError(
                f"a clearance of {clearance:g} mm does not fit into {int(tight.sum())} of {len(tight)} tiles; "
                "ask for a smaller solid.clearance or a larger pattern.tile_size, or divide a mesh with larger faces"
            )
        fewest, waited = min(fewest, int(tight.sum())), waited + 1 if tight.sum() >= fewest else 0
        if not tight.any() or waited == PATIENCE:
            break
        quads = slid_tiles(quads, tight)
        surface = cut(replace(duotone, quads=quads), LimitSurface.of(quads), rings=rings, resolution=resolution)
    return surface


def tight_tiles(surface: CutSurface, *, clearance: float) -> Mask:
    """Return the tiles, (t,) bool, in which copies of a curve cannot be moved `clearance` mm apart."""
    curves = surface.curves
    count = curves.shape[1]
    wanted, everywhere = np.full(count, clearance), np.arange(count)
    near: Mask = np.zeros(count, dtype=bool)
    for depth in (0.0, BENEATH):
        for curve, sides in zip(curves, ray_sides(surface, surface.points - depth * surface.normals), strict=True):
            upright = surface.normals[curve]
            shares = clearance_shares(sides, upright, -upright, clearance=wanted)
            near |= too_near(moved_copies(sides, shares, everywhere), ENOUGH * wanted, suspects=everywhere)
    tight: Mask = np.zeros(len(surface.order) // 2, dtype=bool)
    tight[surface.order[near.reshape(len(surface.order), -1).any(axis=1)] // 2] = True
    return tight
