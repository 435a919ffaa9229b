"""A budget of polygons: a surface divided more coarsely until the parts made of it have no more triangles.

Finished solids are not decimated: that would move facing walls apart or into each other, and make parts cross. The
smooth surface is divided anew instead, by the same rules, so that walls, gap and outside come out as they should at any
resolution, and the chord error is known.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from fabricate.errors import SolidError
from fabricate.solid.assembly import Core, core_region
from fabricate.surface.cut import CutSurface

MARGIN = 1.02
"""By so much more than counts ask for the tolerance grows each time."""

GROWTH, PATIENCE = 1.5, 12
"""How much it grows at least when it has made no difference, and how often that may happen before it is the end."""


CLOSE = 1.01
"""Tolerances that differ by less than this factor are not told apart."""


class Affordable(NamedTuple):
    """A surface whose parts keep a budget, and the tolerance that it was divided with, mm."""

    surface: CutSurface
    tolerance: float


def affordable(
    make: Callable[[float], CutSurface], *, tolerance: float, core: Core, budget: int | None, limit: str = "fewer fit"
) -> Affordable:
    """Divide a surface with the tolerance, mm, or with the finest coarser one whose parts keep the budget.

    `make` divides it with a given tolerance. `budget` is the number of triangles that each part may have, and `limit`
    says in words where it comes from. The resolution of tiles is a whole number: the finest is found that keeps the
    budget.

    Raises
    ------
    SolidError
        If even the coarsest division has more.
    """
    found, growth, waited = Affordable(make(tolerance), tolerance), 1.0, 0
    finer, count = found, largest_part(found.surface, core=core)
    while budget is not None and count > budget and waited < PATIENCE:
        # The error grows with the square of an edge's length, and so does a triangle's area.
        tolerance *= max(growth, MARGIN * count / max(budget, 1))
        finer, found = found, Affordable(make(tolerance), tolerance)
        before, count = count, largest_part(found.surface, core=core)
        growth, waited = (GROWTH, waited + 1) if count == before else (1.0, 0)
    if budget is None or found is finer:
        return found
    if count <= budget:
        return _finest(make, finer, found, core=core, budget=budget)
    raise SolidError(
        f"the largest part has {count} triangles however coarsely it is divided, and {limit}; "
        'ask for a larger pattern.tile_size, or for prepare.detail = "smooth" where the detail of a mesh is kept'
    )


def _finest(
    make: Callable[[float], CutSurface], finer: Affordable, coarser: Affordable, *, core: Core, budget: int
) -> Affordable:
    """Return the finest division from one that has too many triangles to a coarser one that keeps the budget."""
    while _resolution(finer.surface) - _resolution(coarser.surface) > 1 and coarser.tolerance > CLOSE * finer.tolerance:
        tolerance = float(np.sqrt(finer.tolerance * coarser.tolerance))
        between = Affordable(make(tolerance), tolerance)
        if largest_part(between.surface, core=core) <= budget:
            coarser = between
        else:
            finer = between
    return coarser


def _resolution(surface: CutSurface) -> int:
    return int(surface.rays.shape[1]) - 1


def largest_part(surface: CutSurface, *, core: Core) -> int:
    """Return how many triangles the largest part will have: outside, inside, and walls along its curves."""
    regions = len(surface.curves) + 1
    keeper = core_region(core, regions=regions)
    areas = np.bincount(surface.regions, minlength=regions)
    length = surface.curves.shape[1]
    counts = [
        own + (len(surface.triangles) - own if region == keeper else own)
        + 2 * length * (1 if region in (0, regions - 1) else 2) * (2 if region == keeper else 1)
        for region, own in enumerate(areas.tolist())
    ]  # fmt: skip
    return int(max(counts))
