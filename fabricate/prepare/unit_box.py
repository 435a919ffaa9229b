"""The box of diagonal 1 in which tiny and huge shapes are alike."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, frozen

_TINY = float(np.finfo(float).tiny)


@dataclass(frozen=True, eq=False)
class UnitBox:
    """A bounding box that is moved to the origin and scaled to a diagonal of 1, and back.

    Attributes
    ----------
    unit : float
        The largest coordinate, divided by first: the diagonal of huge numbers is none.
    middle : (3,) float
        In that unit.
    diagonal : float
        In that unit; positive.
    """

    unit: float
    middle: Floats
    diagonal: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "middle", frozen(self.middle, np.float64, (3,)))

    @classmethod
    def of(cls, points: Floats) -> UnitBox:
        """Return the box of at least one finite point, (n, 3)."""
        unit = max(float(np.abs(points).max()), _TINY)
        low, high = points.min(axis=0) / unit, points.max(axis=0) / unit
        return cls(unit, (low + high) / 2, max(float(np.linalg.norm(high - low)), _TINY))

    def placed(self, points: Floats) -> Floats:
        """Return the points, (n, 3), in the box."""
        inside: Floats = (points / self.unit - self.middle) / self.diagonal
        return inside

    def restored(self, points: Floats) -> Floats:
        """Return points in the box, (n, 3), where they came from."""
        outside: Floats = (points * self.diagonal + self.middle) * self.unit
        return outside
