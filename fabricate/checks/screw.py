"""Screw motions: rigid motions that go on for as long as one likes, straight ahead, round an axis, or both."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.linalg import expm

from fabricate.arrays import Floats


class Screw(NamedTuple):
    """A motion that begins by moving each point p by shift + turn x (p - pivot), per unit of time.

    Attributes
    ----------
    pivot : (3,) float
        mm.
    shift : (3,) float
        What the pivot moves by, mm.
    turn : (3,) float
        Axis of the turn times its angle, radians.
    """

    pivot: Floats
    shift: Floats
    turn: Floats

    def after(self, time: float) -> Floats:
        """Return the motion as a matrix, (3, 4) float, which takes (x, y, z, 1) to its place at that time.

        It is the exponential of the twist (Murray, Li, Sastry 1994, 2.3).
        """
        x, y, z = self.turn
        twist = np.zeros((4, 4))
        twist[:3, :3] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
        twist[:3, 3] = self.shift - np.cross(self.turn, self.pivot)
        moved: Floats = expm(time * twist)[:3]
        return moved

    def speed(self, radius: float) -> float:
        """Return how far a point at this distance from the pivot moves at most, mm per unit of time."""
        return float(np.linalg.norm(self.shift) + radius * np.linalg.norm(self.turn))
