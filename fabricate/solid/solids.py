"""Both regions made into solids: the inner surface is proposed, tested exactly, and mended until nothing is wrong."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Mask
from fabricate.errors import SolidError
from fabricate.solid.assembly import Assembly, Core, assembly
from fabricate.solid.crossing import crossing_triangles
from fabricate.solid.faults import crossing_points, near_points
from fabricate.solid.inset import SAFE_DEPTH, capped_depth, relaxed, retreated, slid
from fabricate.surface.adjacency import neighbour_means
from fabricate.surface.cut import CutSurface
from fabricate.surface.neck import tile_necks

RETREAT_FROM, RELAX_UNTIL, ALL_ROUNDS = 12, 12, 60
"""Rounds from which stubborn places also retreat, after which they only do, and in all; the checks report the rest."""

CORE_WEB = 0.8
"""Least thickness of a solid core between two pockets, mm."""


def solids(surface: CutSurface, *, thickness: float, clearance: float, core: Core = "hollow") -> Assembly:
    """Make the yellow and the blue solid, `thickness` mm deep with walls `clearance` mm apart.

    Where that is impossible on a small scale the wall is thinner or the gap smaller; `fabricate.checks` measures both.

    Raises
    ------
    SolidError
        If the thickness is not positive, the clearance is negative or as wide as the necks, or the surface
        crosses itself.
    """
    _check_sizes(surface, thickness, clearance)
    _check_embedded(surface)
    between = 1.1 * clearance if core == "hollow" else 2.0 * clearance + CORE_WEB
    depth = capped_depth(surface, thickness=thickness, between=between)
    inner, safe = _under(surface, depth), _under(surface, SAFE_DEPTH * depth)
    means = neighbour_means(surface.triangles, count=len(surface.points))
    moved: Mask = np.ones(len(inner), dtype=bool)
    for step in range(ALL_ROUNDS):
        made = assembly(surface, inner, clearance=clearance, core=core)
        faulty = _faults(made, clearance, moved, all_kinds=step < RETREAT_FROM)
        if not faulty.any():
            return made
        mended = slid(surface, inner, faulty, means) if step < RETREAT_FROM else inner
        if step < RELAX_UNTIL:
            mended = relaxed(mended, faulty, means)
        if step >= RETREAT_FROM:
            mended = retreated(surface, mended, faulty, means, safe=safe)
        moved = (mended != inner).any(axis=1)
        inner = mended
    return made


def _faults(made: Assembly, clearance: float, moved: Mask, *, all_kinds: bool) -> Mask:
    """Return the faulty surface points: crossings, and near places if asked for or once nothing crosses.

    Crossings are looked for around the points that moved; nothing counts as found to be right before
    everything was looked at.
    """
    faulty = crossing_points(made, clearance=clearance, moved=moved)
    if not faulty.any() and not moved.all():
        faulty = crossing_points(made, clearance=clearance, moved=np.ones_like(moved))
    if clearance > 0.0 and (all_kinds or not faulty.any()):
        faulty = faulty | near_points(made, clearance=clearance)
    return faulty


def _under(surface: CutSurface, depth: Floats) -> Floats:
    return surface.points - depth[:, None] * surface.normals


def _check_sizes(surface: CutSurface, thickness: float, clearance: float) -> None:
    if not thickness > 0.0:
        raise SolidError(f"the thickness must be positive, found {thickness:g} mm")
    if not clearance >= 0.0:
        raise SolidError(f"the clearance must not be negative, found {clearance:g} mm")
    neck = float(np.median(tile_necks(surface)[0]))
    if clearance >= neck:
        raise SolidError(
            f"a clearance of {clearance:g} mm leaves nothing of necks that are {neck:.3g} mm wide; "
            "ask for a smaller solid.clearance or a larger pattern.tile_size"
        )


def _check_embedded(surface: CutSurface) -> None:
    pairs = crossing_triangles(surface.points, surface.triangles)
    if len(pairs):
        x, y, z = surface.points[surface.triangles[pairs[0, 0]]].mean(axis=0)
        raise SolidError(
            f"the surface crosses itself, {len(pairs)} pairs of triangles do, one at ({x:.2f}, {y:.2f}, {z:.2f}) mm "
            "of the sized sculpture; no wall can cure that: mend the mesh there"
        )
