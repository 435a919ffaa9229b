"""The duotone record: which tiles are joined across in yellow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Mask, frozen
from fabricate.duotone.quad_mesh import QuadMesh


@dataclass(frozen=True, eq=False)
class Duotone:
    """A two-coloured quad mesh and the state of each of its Truchet tiles.

    Attributes
    ----------
    quads : QuadMesh
        The tiles.
    joined : (t,) bool
        True where the tile's two yellow corners are connected across it, False where the blue ones are.
    """

    quads: QuadMesh
    joined: Mask

    def __post_init__(self) -> None:
        object.__setattr__(self, "joined", frozen(self.joined, np.bool_, (len(self.quads.tiles),)))
