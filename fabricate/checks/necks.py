"""Necks of a finished part: how near two of its walls that face other parts come to each other."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Mask
from fabricate.checks.facts import Narrowest
from fabricate.checks.walls import Walls


def narrowest_neck(measured: Walls, joint: Mask) -> Narrowest | None:
    """Return the narrowest place between two walls of a part that both belong to a joint; None if there is none.

    `joint` says of each triangle of the part, (m,), whether it faces another part. The place is on one
    of the two walls.
    """
    between = np.flatnonzero(joint[measured.faces].all(axis=1))
    if not len(between):
        return None
    x, y, z = (float(value) for value in measured.places[between[0]])
    return Narrowest(float(measured.thickness[between[0]]), (x, y, z))
