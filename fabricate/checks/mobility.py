"""Mobility: whether two rigid parts can come apart, and how far one moves within the other.

Small motions of the first part, the second held still: a point p moves by v + w x (p - c). Where a wall of
one part faces a wall of the other, at distance g along the normal n (from the first part to the second), the
motion must keep n . (v + w x (p - c)) <= g. These are linear, so the farthest motion along x, y, z and the
farthest turn about each of these axes are linear programs, two for each.

The verdict is *fused* if the parts touch, *separable* if a linear program lets the pivot c move by more than
the size of the part in some direction, else *captive*. Turning without end does not count: a ball in a
spherical shell turns freely and yet never gets out. What a turn is depends on the point that stays, so c
must be that of the joint, and it is chosen as the point nearest to all the lines along the normals: the
centre of a ball, on the axis of a peg or a hinge, but not on that of a curved peg that is turned out of its
hole.

All this is of first order, and sees only walls about a clearance apart: loose links of a chain count as
separable. A screw counts as captive when its pitch is so small that a thousand radians do not move it by its
size, and so do parts that would come apart by bending.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.optimize import linprog

from fabricate.arrays import Floats, Indices
from fabricate.checks.check import Check
from fabricate.checks.facts import Play, Verdict
from fabricate.checks.gap import Spacing
from fabricate.solid.part import Part
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

SAMPLES = np.array([[4, 4, 4], [8, 2, 2], [2, 8, 2], [2, 2, 8]]) / 12
"""Barycentric coordinates of the places on each triangle."""

FIRST_ROWS, MORE_ROWS = 400, 100
"""Linear programs begin with some contacts, and get the most violated ones of the rest until none is."""

TOLERANCE = 1e-6
"""By so much of the part's radius, a motion may go into a wall."""

LIMITS = np.repeat([1.0, 1000.0], 3)
"""No motion is followed farther than the part's radius, and no turn farther than this, in radians."""

FREE = np.repeat([0.999, np.pi], 3)
"""Motions as long as the part's radius, and turns by half a turn, are stopped by nothing."""


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


class Mobility(NamedTuple):
    """What the first part can do, to first order, when the second is held; fused parts have no play."""

    verdict: Verdict
    play: Play | None


def mobility(spacing: Spacing, *, clearance: float) -> Mobility:
    """Judge two parts that are `clearance` mm apart, more than 0, by linear programs over their contacts.

    A play is the whole way between two stops: the sum of both directions.
    """
    met = contacts(spacing, clearance=clearance)
    pivot = joint_pivot(met, spacing.first.points.mean(axis=0))
    radius = float(np.linalg.norm(spacing.first.points - pivot, axis=1).max())
    rows = np.hstack([met.normals, np.cross(met.points - pivot, met.normals) / radius])
    ways = _farthest(rows, met.gaps / radius)
    ways[ways >= FREE[:, None]] = np.inf
    separable = bool(np.isinf(ways[:3]).any())
    return Mobility("separable" if separable else "captive", Play(*(radius * ways.sum(axis=1)).tolist()))


def mobility_check(code: str, first: Part, second: Part, found: Mobility, *, expected: Verdict) -> Check:
    """Check that two parts are caught in each other, come apart or are one, as expected."""
    return Check(
        code,
        ok=found.verdict == expected,
        message=f"{first.name} and {second.name} must be {expected}, and they {_meaning(found)}",
    )


def _meaning(found: Mobility) -> str:
    if found.verdict == "fused":
        return "are fused: they touch and are one"
    if found.verdict == "separable" or found.play is None:
        return "are separable: they come apart"
    way = max(found.play.x, found.play.y, found.play.z)
    return f"are captive: they move by up to {way:.3g} mm along the axes, and don't come apart"


def contacts(spacing: Spacing, *, clearance: float) -> Contacts:
    """Find where the walls of two parts face each other, from the triangles of both."""
    own = _facing(spacing.first, spacing.second, spacing.to_second, clearance)
    other = _facing(spacing.second, spacing.first, spacing.to_first, clearance)
    return Contacts(
        np.concatenate([own.points, other.points + other.gaps[:, None] * other.normals]),
        np.concatenate([own.normals, -other.normals]),
        np.concatenate([own.gaps, other.gaps]),
    )


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
    found = other.nearest(points)
    normals, opposite = _normals(own, triangle), _normals(other, found.triangle)
    way = found.point - points
    gaps = np.einsum("ij,ij->i", way, normals)
    facing = (
        (found.distance <= REACH * clearance)
        & (gaps >= FACING * found.distance)
        & (-np.einsum("ij,ij->i", way, opposite) >= FACING * found.distance)
    )
    return Contacts(points[facing], normals[facing], gaps[facing])


def _normals(tree: SearchTree, triangles: Indices) -> Floats:
    return unit(area_vectors(tree.points, tree.triangles[triangles]))


def _samples(tree: SearchTree, triangles: Indices) -> tuple[Floats, Indices]:
    """Return places on the given triangles, (k, 3), evenly thinned out, and the triangle of each."""
    count = len(SAMPLES) * len(triangles)
    chosen = np.arange(0, count, max(1, -(-count // MOST_SAMPLES)))
    triangle, sample = triangles[chosen // len(SAMPLES)], chosen % len(SAMPLES)
    points = np.einsum("ki,kij->kj", SAMPLES[sample], tree.points[tree.triangles[triangle]])
    return points, triangle


def _farthest(rows: Floats, gaps: Floats) -> Floats:
    """Return the farthest motions forward and back along each axis that no contact stops, (6, 2), in radii.

    Most contacts never matter, so a few are handed to the solver first, and others when they turn out to be
    violated (cutting planes).
    """
    active = np.zeros(len(gaps), dtype=bool)
    active[:: max(1, len(gaps) // FIRST_ROWS)] = True
    ways = np.zeros((6, 2))
    for axis, side in np.ndindex(6, 2):
        motion = _motion(axis, (1, -1)[side], rows[active], gaps[active])
        while len(violated := _violated(np.where(active, 0.0, rows @ motion - gaps))):
            active[violated] = True
            motion = _motion(axis, (1, -1)[side], rows[active], gaps[active])
        ways[axis, side] = abs(motion[axis])
    return ways


def _motion(axis: int, sign: int, rows: Floats, gaps: Floats) -> Floats:
    """Return the motion that goes farthest along an axis, (6,), in radii."""
    goal = np.zeros(6)
    goal[axis] = -sign
    solved = linprog(goal, A_ub=rows, b_ub=gaps, bounds=[(-limit, limit) for limit in LIMITS])
    return np.asarray(solved.x, dtype=np.float64)


def _violated(excess: Floats) -> Indices:
    """Return the contacts that a motion violates most."""
    violated = np.flatnonzero(excess > TOLERANCE)
    return violated[np.argsort(-excess[violated], kind="stable")[:MORE_ROWS]]
