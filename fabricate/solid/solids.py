"""Both regions made into solids: the inner surface is proposed, tested exactly, and mended until nothing is wrong."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Mask
from fabricate.errors import SolidError
from fabricate.solid.assembly import Assembly, Core, assembly, core_region
from fabricate.solid.clearance import check_necks
from fabricate.solid.dither import dithered
from fabricate.solid.faults import crossing_points, near_points
from fabricate.solid.inset import capped_depth, downward, relaxed, spread, ways_in
from fabricate.solid.joint import STRAIGHT, Joint, fitted_joint
from fabricate.solid.retreat import Retreat, receded
from fabricate.solid.spacing import outer_copies
from fabricate.solid.thick_enough import check_thick
from fabricate.surface.cut import CutSurface
from fabricate.triangles.adjacency import neighbour_means
from fabricate.triangles.crossing import crossing_triangles

RELAXINGS, LEFT = 4, 0.9
"""How often faults are relaxed before what is left retreats, and the share of them left from which on that ends."""

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
    fitted = fitted_joint(surface, inner, joint, thickness=thinnest, clearance=clearance)
    means = neighbour_means(surface.triangles, count=len(surface.points))

    def tested(inner: Floats, before: _Tested | None) -> _Tested:
        made = assembly(surface, inner, clearance=clearance, core=core, joint=fitted)
        moved = np.ones(len(inner), dtype=bool) if before is None else made.moved_since(before.made) | before.faulty
        return _Tested(inner, made, _faults(made, moved, clearance=clearance))

    best = last = tested(inner, None)
    for _ in range(RELAXINGS):
        if not last.faulty.any():
            break
        slid = spread(surface, last.inner, last.faulty, means)
        last = tested(relaxed(surface, slid, last.faulty, means), last)
        enough = last.faulty.sum() > LEFT * best.faulty.sum()
        best = min(best, last, key=lambda each: int(each.faulty.sum()))
        if enough:
            break
    if not best.faulty.any():
        return dithered(best.made)
    keeper = core_region(core, regions=len(best.made.bodies))
    copies = outer_copies(surface, clearance=clearance) if clearance > 0.0 else (surface.points,)
    retreat = Retreat.of(surface, best.made, copies, thickness=thinnest, keeper=keeper)
    return dithered(receded(retreat, partial(_faults, clearance=clearance), means, faulty=best.faulty))


class _Tested(NamedTuple):
    """Inner points, (n, 3) mm, what is made of them, and the surface points where that is faulty, (n,) bool."""

    inner: Floats
    made: Assembly
    faulty: Mask


def _faults(made: Assembly, moved: Mask, *, clearance: float) -> Mask:
    """Return the surface points where parts cross or are too near, looked for around the points that moved."""
    faulty = crossing_points(made, clearance=clearance, moved=moved)
    return faulty | near_points(made, clearance=clearance, moved=moved) if clearance > 0.0 else faulty


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
