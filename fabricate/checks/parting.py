"""Parting: a solid moved out of another in steps, which proves that they come apart."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from manifold3d import Manifold

from fabricate.checks.screw import Screw

OVERLAP_SHARE = 1e-6
"""Largest common volume on the way, as a share of the moved solid."""

FIRST_STEP, GROWTH = 0.5, 1.4
"""The first step as a share of the clearance, and how much longer each one is than the one before."""

LONGEST_STEP = 1 / 60
"""Longest step as a share of the moved solid's radius: shorter than walls are thick."""

FARTHEST = 6.0
"""A solid that is not out after so many radii does not come out this way."""


def comes_out(moving: Manifold, other: Manifold, way: Screw, *, clearance: float, radius: float) -> bool:
    """Tell whether a solid can follow a screw out of another without overlapping it at any step.

    It is out when the convex hulls of both have nothing in common: then it can go on straight ahead
    for ever. `radius` is the distance of its farthest point from the screw's pivot, mm.
    """
    hull, around = moving.hull(), other.hull()
    most = OVERLAP_SHARE * moving.volume()
    for time in _times(way, clearance, radius):
        place = way.after(time)
        if (hull.transform(place) ^ around).is_empty():
            return True
        if (moving.transform(place) ^ other).volume() > most:
            return False
    return False


def _times(way: Screw, clearance: float, radius: float) -> Iterator[float]:
    """Yield the times at which the solid is looked at, from its seat on."""
    speed = way.speed(radius)
    gone, step = 0.0, FIRST_STEP * clearance
    angle = float(np.linalg.norm(way.turn))
    farthest = FARTHEST * radius if angle == 0.0 else min(FARTHEST * radius, 2 * np.pi * speed / angle)
    while gone <= farthest:
        yield gone / speed
        gone += step
        step = min(GROWTH * step, LONGEST_STEP * radius)
