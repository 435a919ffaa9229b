"""Steps of a surface's points that lead from a faultless surface to a faultless one.

The points move, the result is tested, and around what is wrong they are held back: they take half of the step, then
none of it, in a neighbourhood that grows until nothing is wrong.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from fabricate.arrays import Floats, Mask
from fabricate.errors import SolidError
from fabricate.surface.embedding import Faulty, stored
from fabricate.triangles.adjacency import grown

ROUNDS, HALVED = 24, 2
"""Rounds in all, and those in which a step is halved where it is wrong; after these it is not done there."""

BLUR = 2
"""Rings over which a step that is held back turns into a whole one."""

RINGS, SWEEPS = 2, 3
"""How far around a fault points are relaxed, at first, in edges, and how often in a round."""


def stepped(old: Floats, new: Floats, means: csr_array, faulty: Faulty) -> Floats:
    """Return the points moved from `old` to `new`, both (n, 3) mm, and held back around what would be wrong.

    Nothing may be wrong with `old`, float32-exact; then nothing is with the result, which is float32-exact as well.
    """
    held, points = np.zeros(len(old)), stored(new)
    moved: Mask = (points != old).any(axis=1)
    for step in range(ROUNDS):
        wrong = faulty(points, moved)
        if not wrong.any():
            return points
        around = grown(wrong, means, 1 + step // HALVED).astype(np.float64)
        for _ in range(BLUR):
            around = np.maximum(around, means @ around)
        held += (1.0 - held) * around * (0.5 if step < HALVED else 1.0)
        before, points = points, stored(new + held[:, None] * (old - new))
        moved = wrong | (points != before).any(axis=1)
    return old


def untangled(points: Floats, means: csr_array, faulty: Faulty) -> Floats:
    """Return the points, (n, 3) mm, float32-exact, relaxed around all that is wrong until nothing is.

    Raises
    ------
    SolidError
        If relaxing does not cure it.
    """
    points = stored(points)
    wrong = faulty(points, np.ones(len(points), dtype=bool))
    for step in range(ROUNDS):
        if not wrong.any():
            return points
        around = grown(wrong, means, RINGS + step)
        for _ in range(SWEEPS):
            points = np.where(around[:, None], means @ points, points)
        points = stored(points)
        wrong = faulty(points, around)
    x, y, z = points[wrong][0]
    raise SolidError(
        f"the smooth surface crosses itself around {int(wrong.sum())} points, one at ({x:.2f}, {y:.2f}, "
        f"{z:.2f}) mm of the sized sculpture: ask for a smaller pattern.tile_size, or thicken the mesh there"
    )
