"""One printable solid: a name and a closed triangle mesh in float32-exact coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices, frozen


@dataclass(frozen=True, eq=False)
class Part:
    """A closed, outward-oriented triangle mesh with a name.

    Triangles are counter-clockwise seen from outside. Coordinates are rounded to float32 on
    construction, so that whatever is tested is exactly what a binary STL will hold.

    Attributes
    ----------
    name : str
        Also the file's stem: "yellow", "blue".
    points : (n, 3) float
        mm; every value is exactly representable in float32.
    triangles : (m, 3) int
        Indices into `points`.
    """

    name: str
    points: Floats
    triangles: Indices

    def __post_init__(self) -> None:
        rounded = np.asarray(self.points, dtype=np.float32).astype(np.float64) + 0.0  # -0.0 becomes 0.0
        object.__setattr__(self, "points", frozen(rounded, np.float64, (None, 3)))
        object.__setattr__(self, "triangles", frozen(self.triangles, np.int64, (None, 3)))


def joined(name: str, parts: Sequence[Part]) -> Part:
    """Return all triangles of some parts as one part with a name."""
    begins = np.cumsum([0, *(len(part.points) for part in parts)])
    triangles = [part.triangles + begin for part, begin in zip(parts, begins[:-1], strict=True)]
    return Part(name, np.concatenate([part.points for part in parts]), np.concatenate(triangles))
