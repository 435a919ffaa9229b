"""Mobility: whether a rigid part can leave another, and how far it moves within it.

Small motions of the first part, the second held still: a point p moves by v + w x (p - c). Where a wall of
one part faces a wall of the other, at distance g along the normal n (from the first part to the second), the
motion must keep n . (v + w x (p - c)) <= g. These are linear, so the farthest motion along x, y, z and the
farthest turn about each of these axes are linear programs, two for each.

The part is *caught* unless a linear program lets the pivot c move by more than
the size of the part in some direction. Turning without end does not count: a ball in a
spherical shell turns freely and yet never gets out. What a turn is depends on the point that stays, so c
must be that of the joint, and it is chosen as the point nearest to all the lines along the normals: the
centre of a ball, on the axis of a peg or a hinge, but not on that of a curved peg that is turned out of its
hole.

All this is of first order, and sees only walls about a clearance apart: loose links of a chain count as free.
So what is free has its ways out, to be tried on the solids themselves (`fabricate.checks.parting`), and what is
caught its proof (`fabricate.checks.witness`). A screw counts as caught when its pitch is so small that a
thousand radians do not move it by its size, and so do parts that would come apart by bending.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.optimize import linprog

from fabricate.arrays import Floats, Indices
from fabricate.checks.contacts import Contacts, joint_pivot
from fabricate.checks.facts import Play
from fabricate.checks.screw import Screw

FIRST_ROWS, MORE_ROWS = 400, 100
"""Linear programs begin with some contacts, and get the most violated ones of the rest until none is."""

TOLERANCE = 1e-6
"""By so much of the part's radius, a motion may go into a wall."""

SLIDING = 1e-3
"""Share of the gaps that a way out may use up over the part's radius: it goes on, and must not drift into a wall."""

LIMITS = np.repeat([1.0, 1000.0], 3)
"""No motion is followed farther than the part's radius, and no turn farther than this, in radians."""

FREE = np.repeat([0.999, np.pi], 3)
"""Motions as long as the part's radius, and turns by half a turn, are stopped by nothing."""


class Mobility(NamedTuple):
    """What one part can do, to first order, when the other is held.

    Attributes
    ----------
    play : Play
        How far it moves from its seat.
    ways_out : tuple of Screw
        Motions that no contact stops; none of a part that is caught.
    pivot : (3,) float
        The point that stays when it turns, mm.
    radius : float
        Distance of the part's farthest point from it, mm.
    """

    play: Play
    ways_out: tuple[Screw, ...]
    pivot: Floats
    radius: float

    @property
    def caught(self) -> bool:
        """True when contacts stop the part in every direction."""
        return not self.ways_out


def mobility(met: Contacts, points: Floats) -> Mobility:
    """Find out what the part with these points, (n, 3), can do, by linear programs over its contacts.

    The play along an axis is the way from the seat to the farther of the two stops; the seat is where the part
    was modelled, midway between them.
    """
    pivot = joint_pivot(met, points.mean(axis=0))
    radius = float(np.linalg.norm(points - pivot, axis=1).max())
    rows, gaps = motion_rows(met, pivot, radius), met.gaps / radius
    ways = np.zeros((6, 2))
    for axis, side in np.ndindex(6, 2):
        ways[axis, side] = abs(_farthest(rows, gaps, axis=axis, sign=(1, -1)[side])[axis])
    ways[ways >= FREE[:, None]] = np.inf
    free = [(int(axis), (1, -1)[side]) for axis, side in np.argwhere(np.isinf(ways[:3]))]
    out = tuple(_way_out(rows, gaps, pivot, radius, axis=axis, sign=sign) for axis, sign in free)
    return Mobility(Play(*(radius * ways.max(axis=1)).tolist()), out, pivot, radius)


def motion_rows(met: Contacts, pivot: Floats, radius: float) -> Floats:
    """Return how far each contact's point goes along its normal by a unit of each motion, (k, 6).

    The motions are those along x, y, z and the turns about these axes through the pivot, both measured in radii.
    """
    return np.hstack([met.normals, np.cross(met.points - pivot, met.normals) / radius])


def _way_out(rows: Floats, gaps: Floats, pivot: Floats, radius: float, *, axis: int, sign: int) -> Screw:
    """Return the simplest motion that goes on along an axis: straight if it can be, and without drift."""
    still = np.zeros(6)
    for straight, share in ((True, SLIDING), (False, SLIDING), (False, 1.0)):
        allowed = rows[:, :3] if straight else rows
        motion = _farthest(allowed, share * gaps, axis=axis, sign=sign)
        found = np.concatenate([motion, still[: 6 - len(motion)]])
        if abs(found[axis]) >= FREE[axis]:
            break
    return Screw(pivot, radius * found[:3], found[3:])


def _farthest(rows: Floats, gaps: Floats, *, axis: int, sign: int) -> Floats:
    """Return the motion that goes farthest forward or back along an axis and that no contact stops, in radii.

    Most contacts never matter, so a few are handed to the solver first, and others when they turn out to be
    violated (cutting planes).
    """
    active = np.zeros(len(gaps), dtype=bool)
    active[:: max(1, len(gaps) // FIRST_ROWS)] = True
    while True:
        motion = _motion(axis, sign, rows[active], gaps[active])
        violated = _violated(np.where(active, 0.0, rows @ motion - gaps))
        if not len(violated):
            return motion
        active[violated] = True


def _motion(axis: int, sign: int, rows: Floats, gaps: Floats) -> Floats:
    goal = np.zeros(rows.shape[1])
    goal[axis] = -sign
    bounds = [(-limit, limit) for limit in LIMITS[: len(goal)]]
    return np.asarray(linprog(goal, A_ub=rows, b_ub=gaps, bounds=bounds).x, dtype=np.float64)


def _violated(excess: Floats) -> Indices:
    """Return the contacts that a motion violates most."""
    violated = np.flatnonzero(excess > TOLERANCE)
    return violated[np.argsort(-excess[violated], kind="stable")[:MORE_ROWS]]
