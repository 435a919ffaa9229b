"""Widening: new tiles whose necks are too narrow to print grow at the cost of the larger ones around them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fabricate.arrays import Floats
from fabricate.duotone.duotone import Duotone
from fabricate.surface.cut import cut
from fabricate.surface.limit import LimitSurface
from fabricate.surface.neck import tile_necks
from fabricate.surface.tile_sliding import slid_tiles

COARSE = 6
"""Resolution at which necks are measured: within 3 % of what they are on the finished surface."""

ROUNDS, PATIENCE = 40, 6
"""Rounds of measuring and sliding, and rounds without progress before giving up."""


def coarse_necks(duotone: Duotone, *, arc: float) -> Floats:
    """Return the width of each tile's neck, (t,) float, mm, before clearance is taken off, measured quickly.

    Raises
    ------
    PatternError
        If the tiles form more than one curve, or the arc position is out of range.
    """
    return tile_necks(cut(duotone, LimitSurface.of(duotone.quads), arc=arc, resolution=COARSE))[0]


def widened(duotone: Duotone, *, arc: float, neck: float) -> Duotone:
    """Return the duotone, tiles slid over the surface until no neck is narrower than `neck` mm, if they can be.

    Where a body is too thin for that, the tiling with the fewest narrow necks is returned. The surface changes
    slightly where tiles slide; detail that is carried onto it afterwards brings it back.
    """
    best, fewest, waited = duotone, len(duotone.joined) + 1, 0
    for _ in range(ROUNDS):
        narrow = coarse_necks(duotone, arc=arc) < neck
        count = int(np.count_nonzero(narrow))
        best, waited = (duotone, 0) if count < fewest else (best, waited + 1)
        fewest = min(fewest, count)
        if count == 0 or waited == PATIENCE:
            break
        duotone = replace(duotone, quads=slid_tiles(duotone.quads, narrow))
    return best
