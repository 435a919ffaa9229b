"""Necks of a finished part: how near two of its walls that face other parts come to each other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fabricate.checks.contacts import Facing
from fabricate.checks.facts import Narrowest
from fabricate.checks.walls import Walls

AT_A_TIME = 2_000
"""So many walls are looked at together, the thinnest first: most often the first few have the neck."""


def narrowest_neck(measured: Walls, joints: Sequence[Facing]) -> Narrowest | None:
    """Return the narrowest place between two walls of a part that both belong to a joint; None if there is none.

    `joints` are those of the part with every other part. The place is on one of the two walls.
    """
    near = np.zeros(len(measured.faces), dtype=bool)
    if joints:
        near = np.logical_or.reduce([joint.near for joint in joints])[measured.faces].all(axis=1)
    hopeful = np.flatnonzero(near)
    for begin in range(0, len(hopeful), AT_A_TIME):
        some = hopeful[begin : begin + AT_A_TIME]
        faces = measured.faces[some]
        facing = np.logical_or.reduce([joint.among(faces.ravel()) for joint in joints]).reshape(faces.shape)
        between = some[facing.all(axis=1)]
        if len(between):
            x, y, z = (float(value) for value in measured.places[between[0]])
            return Narrowest(float(measured.thickness[between[0]]), (x, y, z))
    return None
