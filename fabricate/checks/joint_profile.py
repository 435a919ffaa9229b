"""The joint of the finished walls: how much they lean, how far a ridge stands out, and whether that holds."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats
from fabricate.checks.check import Check
from fabricate.checks.facts import JointFacts, Spread
from fabricate.solid.assembly import Assembly
from fabricate.solid.joint import JointKind
from fabricate.surface.cut import CutSurface
from fabricate.triangles.normals import unit


class _Profile(NamedTuple):
    """Measured at each point of the curves: lean, degrees, and a ridge's height and width, mm; (k,) float each."""

    lean: Floats
    height: Floats
    width: Floats


def joint_facts(surface: CutSurface, made: Assembly, kind: JointKind) -> JointFacts:
    """Measure the walls along all curves."""
    profiles = [_profile(surface, made.walls(curve, region), region) for region, curve in enumerate(surface.curves)]
    lean, height, width = map(np.concatenate, zip(*profiles, strict=True))
    facts = JointFacts(kind, float(np.median(lean)))
    if kind != "tongue":
        return facts
    ridge = Spread(float(height.min()), float(np.median(height)))
    return JointFacts(kind, facts.lean_deg, ridge, float(np.median(width)))


def joint_checks(joint: JointFacts, *, clearance: float) -> tuple[Check, ...]:
    """Check that a ridge stands out by more than the gap, mm, so that it holds; no check where there is none to hold.

    A lower one passes through the gap.
    """
    if joint.ridge_mm is None or clearance == 0.0:
        return ()
    height = joint.ridge_mm.median
    message = (
        f"the tongue must stand out by more than the clearance of {clearance:.4g} mm to hold, and its median height is "
        f"{height:.4g} mm"
    )
    ok = height > clearance
    cure = "" if ok else "; ask for a smaller solid.clearance, a larger pattern.tile_size or a thicker wall"
    return (Check("fit.ridge", ok=ok, message=message + cure),)


def _profile(surface: CutSurface, walls: Floats, region: int) -> _Profile:
    """Measure facing walls, (2, l, c, 3) mm, along the curve between a region and the next."""
    outer, inner = walls[:, 0].mean(axis=0), walls[:, -1].mean(axis=0)
    normals = surface.normals[surface.curves[region]]
    tangent = unit(np.roll(outer, -1, axis=0) - np.roll(outer, 1, axis=0))
    down = inner - outer
    aside, deep = _along(down, unit(np.cross(tangent, normals))), -_along(down, normals)
    across = unit(np.cross(down, tangent))
    top = walls[0, walls.shape[1] // 2] - walls[0, [0, -1]].mean(axis=0)
    width = np.linalg.norm(walls[:, -2] - walls[:, 1], axis=2).mean(axis=0)
    return _Profile(np.degrees(np.arctan2(aside, deep)), _along(top, across), width)


def _along(vectors: Floats, ways: Floats) -> Floats:
    """Return the component of each vector, (c, 3), along its unit vector, (c,)."""
    component: Floats = np.einsum("ij,ij->i", vectors, ways)
    return component
