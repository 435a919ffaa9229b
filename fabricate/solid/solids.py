"""Both regions made into solids: the inner surface is proposed, tested exactly, and mended until nothing is wrong."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Mask
from fabricate.errors import SolidError
from fabricate.solid.assembly import Assembly, Core, assembly
from fabricate.solid.clearance import check_necks
from fabricate.solid.dither import dithered
from fabricate.solid.faults import crossing_points, near_points
from fabricate.solid.inset import (
    SAFE_DEPTH,
    capped_depth,
    downward,
    relaxed,
    retreated,
    retreating,
    safe_share,
    spread,
    straight_down,
    ways_in,
)
from fabricate.solid.joint import STRAIGHT, Joint, fitted_joint
from fabricate.solid.thick_enough import check_thick
from fabricate.surface.cut import CutSurface
from fabricate.triangles.adjacency import neighbour_means
from fabricate.triangles.crossing import crossing_triangles

RETREAT_FROM, ALL_ROUNDS = 4, 80
"""Round from which stubborn places retreat, and rounds in all; the checks report what is left."""

PATIENCE, UNHEEDED = 20, 3
"""Rounds of retreat in which nothing gets better, before the rest is left as it is; and before places that are too near
are seen to although others still cross."""

CORE_WEB = 0.8
"""Least thickness of a solid core between two pockets, mm."""


def solids(
    surface: CutSurface,
    *,
    thickness: float | Floats,
    clearance: float,
    core: Core = "hollow",
    joint: Joint = STRAIGHT,
) -> Assembly:
    """Make the yellow and the blue solid, `thickness` mm deep with walls `clearance` mm apart.

    The thickness is the same everywhere, or (n,), one under each point of the surface.
    Where that is impossible on a small scale the wall is thinner or the gap smaller; `fabricate.checks` measures both.

    Raises
    ------
    SolidError
        If the thickness is not positive, the clearance is negative or as wide as the necks or as most of the body is
        thick, or the surface crosses itself, or the joint does not fit.
    """
    thinnest, thickest = float(np.min(thickness)), float(np.max(thickness))
    _check_sizes(surface, thinnest, clearance)
    _check_embedded(surface)
    check_thick(surface.points, surface.triangles, clearance=clearance)
    between = 1.1 * clearance if core == "hollow" else 2.0 * clearance + CORE_WEB
    down = downward(surface.points, surface.triangles, ways_in(surface, thickness=thickest))
    depth = capped_depth(surface, down, thickness=thickness, between=between)
    inner = surface.base + depth[:, None] * down
    straight = SAFE_DEPTH * thinnest * straight_down(surface.points, surface.triangles)
    fitted = fitted_joint(surface, inner, joint, thickness=thinnest, clearance=clearance)
    means = neighbour_means(surface.triangles, count=len(surface.points))
    moved: Mask = np.ones(len(inner), dtype=bool)
    times = np.zeros(len(inner), dtype=np.int64)
    fewest, waited = np.full(2, len(inner)), 0
    for step in range(ALL_ROUNDS):
        made = assembly(surface, inner, clearance=clearance, core=core, joint=fitted)
        stuck = waited >= UNHEEDED
        all_kinds = step < RETREAT_FROM or stuck
        crossing, near = _faults(made, clearance, moved | stuck, all_kinds=all_kinds)
        faulty = crossing | near
        if not faulty.any():
            break
        if step >= RETREAT_FROM:
            left = np.array([crossing.sum(), near.sum() if all_kinds or not crossing.any() else len(inner)])
            fewest, waited = np.minimum(fewest, left), waited + 1 if (left >= fewest).all() else 0
            if waited == PATIENCE:
                break
        if step < RETREAT_FROM:
            mended = relaxed(surface, spread(surface, inner, faulty, means), faulty, means)
        else:
            around = retreating(surface, faulty, means)
            times += around
            safe = surface.points + safe_share(times)[:, None] * straight
            mended = retreated(inner, around, means, safe=safe, times=times)
        moved = (mended != inner).any(axis=1)
        inner = mended
    return dithered(made)


def _faults(made: Assembly, clearance: float, moved: Mask, *, all_kinds: bool) -> tuple[Mask, Mask]:
    """Return the surface points where parts cross, and near places if asked for or once nothing crosses.

    Both are looked for around the points that moved; nothing counts as found to be right before everything
    was looked at.
    """
    crossing = crossing_points(made, clearance=clearance, moved=moved)
    near: Mask = np.zeros_like(crossing)
    if clearance > 0.0 and (all_kinds or not crossing.any()):
        near = near_points(made, clearance=clearance, moved=moved)
    if not (crossing | near).any() and not moved.all():
        return _faults(made, clearance, np.ones_like(moved), all_kinds=True)
    return crossing, near


def _check_sizes(surface: CutSurface, thickness: float, clearance: float) -> None:
    if not thickness > 0.0:
        raise SolidError(f"the thickness must be positive, found {thickness:g} mm")
    if not clearance >= 0.0:
        raise SolidError(f"the clearance must not be negative, found {clearance:g} mm")
    check_necks(surface, clearance=clearance)


def _check_embedded(surface: CutSurface) -> None:
    pairs = crossing_triangles(surface.points, surface.triangles)
    if len(pairs):
        x, y, z = surface.points[surface.triangles[pairs[0, 0]]].mean(axis=0)
        raise SolidError(
            f"the surface crosses itself, {len(pairs)} pairs of triangles do, one at ({x:.2f}, {y:.2f}, {z:.2f}) mm "
            "of the sized sculpture; no wall can cure that: mend the mesh there"
        )
