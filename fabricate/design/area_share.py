"""Area share: the arc position at which yellow has the share of the finished surface that is asked for."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq

from fabricate.arrays import Floats
from fabricate.duotone.duotone import Duotone
from fabricate.errors import PatternError
from fabricate.surface.cut import CutSurface, cut
from fabricate.surface.limit import LimitSurface
from fabricate.triangles.normals import area_vectors

WITHIN = 0.001
"""How near to the share asked for that of the finished surface is promised to be."""

NEAR_ENOUGH, ROUNDS = 0.4 * WITHIN, 6
"""Difference below which no better arc position is looked for, and how many surfaces are made for it at most."""

ARC_LOW, ARC_HIGH = 0.295, 0.705
"""Arc positions between which one is looked for: a little within those at which the arcs of a tile meet."""

SQUARE_LOW, SQUARE_HIGH = 0.32, 0.68
"""Arc positions between which a first guess lies, so that tiles are not chosen for necks that hardly exist."""

COARSE = 6
"""Segments per arc of the surfaces on which the arc position is solved at first."""

HALVINGS = 8
"""How often the way from the middle to the end of the arc positions is halved to find out which are in reach."""


def area_shares(surface: CutSurface) -> Floats:
    """Return the share of the area that each region of a cut surface has, from yellow to blue, between 0 and 1."""
    area = np.linalg.norm(area_vectors(surface.points, surface.triangles), axis=1)
    shares: Floats = np.bincount(surface.regions, area) / area.sum()
    return shares


def yellow_share(surface: CutSurface) -> float:
    """Return yellow's share of the area of a cut surface, between 0 and 1."""
    return float(area_shares(surface)[0])


def square_arc(share: float) -> float:
    """Return the arc position that gives yellow this share on square tiles, half of them joined: a first guess.

    The share is 1/2 + (pi / 4)(2 r - 1) there: two quarter discs of radius 1 - r are blue on every yellow-joined
    tile, and two of radius r are yellow on every other.
    """
    return float(np.clip(0.5 + (2.0 / np.pi) * (share - 0.5), SQUARE_LOW, SQUARE_HIGH))


def shared_cut(
    duotone: Duotone,
    *,
    share: float,
    make: Callable[[tuple[float]], CutSurface],
    fits: Callable[[CutSurface], bool],
) -> CutSurface:
    """Return the finished surface on which yellow has the share asked for.

    The share grows steadily with the arc position. It is solved for on the smooth surface, coarsely tessellated, and
    then corrected by what is found on the finished one, where tiles may have slid and detail was carried.

    Parameters
    ----------
    duotone : Duotone
    share : float
        Yellow's share, between 0 and 1.
    make : callable
        Makes the finished surface with one ring.
    fits : callable
        Tells of a coarse surface whether its necks are wide enough for the finished one to be made.

    Raises
    ------
    PatternError
        If no arc position gives that share; the message says which shares are in reach.
    """
    limit = LimitSurface.of(duotone.quads)

    def coarse(arc: float) -> CutSurface:
        return cut(duotone, limit, rings=(arc,), resolution=COARSE)

    def surplus(arc: float) -> float:
        return yellow_share(coarse(arc)) - share

    lowest, highest = surplus(ARC_LOW), surplus(ARC_HIGH)
    if lowest > 0.0 or highest < 0.0:
        raise _out_of_reach(share, coarse, fits)
    arc = float(brentq(surplus, ARC_LOW, ARC_HIGH, xtol=1e-5))
    if not fits(coarse(arc)):
        raise _out_of_reach(share, coarse, fits)
    return _corrected(share, arc, make, slope=(highest - lowest) / (ARC_HIGH - ARC_LOW))


def _corrected(share: float, arc: float, make: Callable[[tuple[float]], CutSurface], *, slope: float) -> CutSurface:
    """Return the finished surface nearest to the share, from an arc position close to the one it needs."""
    best = found = make((arc,))
    for _ in range(ROUNDS):
        missing = share - yellow_share(found)
        if abs(missing) <= NEAR_ENOUGH:
            return found
        best = min(best, found, key=lambda surface: abs(share - yellow_share(surface)))
        arc = float(np.clip(arc + missing / slope, ARC_LOW, ARC_HIGH))
        found = make((arc,))
    return best


def _out_of_reach(
    share: float, coarse: Callable[[float], CutSurface], fits: Callable[[CutSurface], bool]
) -> PatternError:
    """Return the error that says which shares are in reach, rounded to the safe side."""
    if not fits(coarse(0.5)):
        return PatternError(
            "no area share is in reach: necks leave no room for the clearance even where both colours have half of the "
            "surface; ask for a smaller solid.clearance or a larger pattern.tile_size"
        )
    ends = (yellow_share(coarse(_farthest(end, coarse, fits))) for end in (ARC_LOW, ARC_HIGH))
    low, high = (float(rounded(100.0 * end) / 100.0) for rounded, end in zip((np.ceil, np.floor), ends, strict=True))
    return PatternError(
        f"an area share of {share:g} is out of reach: with this surface and tree yellow can have {low:.2f} to "
        f"{high:.2f}, where necks leave room for the clearance; ask for a pattern.area_share between them"
    )


def _farthest(end: float, coarse: Callable[[float], CutSurface], fits: Callable[[CutSurface], bool]) -> float:
    """Return the arc position nearest to an end that leaves necks; 1/2 does."""
    if fits(coarse(end)):
        return end
    good, bad = 0.5, end
    for _ in range(HALVINGS):
        middle = 0.5 * (good + bad)
        good, bad = (middle, bad) if fits(coarse(middle)) else (good, middle)
    return good
