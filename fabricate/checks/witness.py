"""The witness of a captive part: a few contacts that between them stop every motion.

A contact with the row r stops a motion m, of six numbers, where r . m reaches its gap. Contacts stop every motion when
their rows positively span all of the space: every direction is a sum of rows with weights of at least 0. The weighted
sum of their gaps then bounds how far any motion goes in that direction. That is the dual of the linear programs of
`fabricate.checks.mobility`, and can be checked with pencil and paper. A ball in a shell turns freely, and its rows span
the straight motions only, which is enough. Weights without bounds prove nothing: the facets of a bent peg in its bent
hole stop it after many of its lengths, on paper.

At most twice as many rows as the space has dimensions are ever needed (Steinitz's theorem on positive bases; Davis,
Theory of positive linear dependence, 1954): twelve.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.optimize import linprog

from fabricate.arrays import Floats, Indices
from fabricate.checks.contacts import Contacts
from fabricate.checks.mobility import FREE, motion_rows

FEW = 2000
"""Contacts among which a witness is looked for first, before all are."""

AS_TIGHT = 3.0
"""How much farther motions may go when only the witness stops them than when all contacts do."""


def witness(met: Contacts, pivot: Floats, radius: float) -> Contacts | None:
    """Return a few contacts that stop every motion of a part, or at least every straight one; None if none do.

    Of those it has, none can be left out. `pivot` and `radius` are those of its mobility, mm.
    """
    rows, gaps = motion_rows(met, pivot, radius), met.gaps / radius
    for every in (max(1, len(rows) // FEW), 1):
        some = np.arange(0, len(rows), every)
        for targets in (_all_motions(), _straight_motions()):
            chosen = _stopping(rows[some], gaps[some], targets)
            if chosen is not None:
                return Contacts(*(array[some[chosen]] for array in met))
    return None


def farthest(rows: Floats, gaps: Floats, target: Floats) -> tuple[float, Indices]:
    """Return how far a motion can go along the target, (6,), and the numbers of the few rows that stop it.

    Distances are in radii, as gaps are. Where nothing stops the motion it goes to inf.
    """
    if not len(rows):
        return np.inf, np.zeros(0, dtype=np.int64)
    solved = linprog(gaps, A_eq=rows.T, b_eq=target, bounds=(0.0, None))
    if solved.x is None or solved.fun is None:
        return np.inf, np.zeros(0, dtype=np.int64)
    return float(solved.fun), np.flatnonzero(solved.x > 0.0)


def _all_motions() -> Floats:
    """Seven directions that positively span all six dimensions, (7, 6)."""
    return np.vstack([np.eye(6), -np.ones((1, 6)) / np.sqrt(6)])


def _straight_motions() -> Floats:
    """Four directions that positively span the straight motions, (4, 6)."""
    return np.hstack([np.vstack([np.eye(3), -np.ones((1, 3)) / np.sqrt(3)]), np.zeros((4, 3))])


def _stopping(rows: Floats, gaps: Floats, targets: Floats) -> Indices | None:
    """Return the numbers of a few rows that stop every motion along the targets; None where not even all of them do."""
    limits = np.abs(targets) @ FREE
    supports: list[Indices] = []
    for k, target in enumerate(targets):
        way, stops = farthest(rows, gaps, target)
        if not way < limits[k]:
            return None
        limits[k] = min(limits[k], AS_TIGHT * way)
        supports.append(stops)
    found = np.unique(np.concatenate(supports))
    for number in found[np.argsort(-gaps[found], kind="stable")]:
        left = found[found != number]
        without = _without(number, left, rows, gaps, targets=targets, limits=limits, supports=supports)
        if without is not None:
            found, supports = left, without
    return found


def _without(
    number: int,
    left: Indices,
    rows: Floats,
    gaps: Floats,
    *,
    targets: Floats,
    limits: Floats,
    supports: Sequence[Indices],
) -> list[Indices] | None:
    """Return the rows among `left` that stop the motion along each target within its limit; None where none do.

    Rows that stop a motion without the one that is left out go on to do so: only the other targets are looked at.
    """
    stopping = list(supports)
    for k, support in enumerate(supports):
        if number in support:
            way, stops = farthest(rows[left], gaps[left], targets[k])
            if not way < limits[k]:
                return None
            stopping[k] = left[stops]
    return stopping
