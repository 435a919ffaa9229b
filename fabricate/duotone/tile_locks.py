"""Tiles whose state is settled before a tree grows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Mask, frozen
from fabricate.duotone.quad_mesh import QuadMesh


@dataclass(frozen=True, eq=False)
class TileLocks:
    """Tiles that have to be joined in one colour.

    Attributes
    ----------
    yellow, blue : (t,) bool
        True where a tile is joined in that colour, whatever happens; never in both.
    """

    yellow: Mask
    blue: Mask

    def __post_init__(self) -> None:
        object.__setattr__(self, "yellow", frozen(self.yellow, np.bool_, (None,)))
        object.__setattr__(self, "blue", frozen(self.blue, np.bool_, (len(self.yellow),)))
        if (self.yellow & self.blue).any():
            raise ValueError("a tile was locked in both colours")

    @classmethod
    def none(cls, quads: QuadMesh) -> TileLocks:
        """Return locks that hold no tile."""
        nothing = np.zeros(len(quads.tiles), dtype=bool)
        return cls(nothing, nothing)

    @property
    def free(self) -> Mask:
        """(t,) bool: tiles that may be joined either way."""
        return ~(self.yellow | self.blue)
