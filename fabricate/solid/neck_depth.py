"""Depth that leaves necks wide: walls that are shallower where those of a neck come too near to each other below.

On the outside of a sharp bend they do on their way down, and a wall that is thinner there, though not too thin to
print, ends before.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fabricate.arrays import Floats
from fabricate.solid.inset import ways_in
from fabricate.surface.cut import CutSurface
from fabricate.surface.neck import tile_necks
from fabricate.triangles.adjacency import undirected_edges

SHARES = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4)
"""Shares of the thickness that are tried for each tile, from the whole of it."""

SLOPE, PASSES = 0.25, 80
"""By how much the thickness may change per mm along the surface, and over so many edges at most."""


def thickness_for_necks(surface: CutSurface, thickness: float | Floats, *, neck: float, least: float) -> float | Floats:
    """Return the thickness under each point, (n,) float, mm: less where a neck would be too narrow at that depth.

    Where no neck is, it is what was given.

    Parameters
    ----------
    surface : CutSurface
        n points.
    thickness : float or (n,) float
        What is asked for, mm.
    neck : float
        Narrowest neck that will do before clearance is taken off, mm. One that is narrower on the surface already
        does not make the wall thinner.
    least : float
        The thickness becomes no smaller than this for the sake of necks, mm.
    """
    asked: Floats = np.broadcast_to(thickness, (len(surface.points),)).astype(np.float64)
    above = np.minimum(tile_necks(surface)[0], tile_necks(replace(surface, points=surface.base))[0])
    goal = np.minimum(neck, above)
    ways = ways_in(surface, thickness=float(asked.max()))
    share = np.full(len(goal), SHARES[-1])
    for tried in SHARES[::-1]:
        deep = replace(surface, points=surface.base + (tried * asked)[:, None] * ways)
        share = np.where(tile_necks(deep)[0] >= goal, tried, share)
    if (share == 1.0).all():
        return thickness
    limited = np.minimum(np.maximum(_at_points(surface, share) * asked, least), asked)
    return _gentle(surface, limited)


def _at_points(surface: CutSurface, share: Floats) -> Floats:
    """Return the smallest share of the tiles at each point, (n,) float, from those of the tiles, (t,)."""
    least = np.ones(len(surface.points))
    rays = surface.rays.reshape(len(surface.rays), -1)
    np.minimum.at(least, rays, np.repeat(share, 2)[:, None])
    return least


def _gentle(surface: CutSurface, thickness: Floats) -> Floats:
    """Return the largest thickness that is nowhere above that given and changes gently."""
    thickness = thickness.copy()
    ends = undirected_edges(surface.triangles)
    span = SLOPE * np.linalg.norm(surface.points[ends[:, 0]] - surface.points[ends[:, 1]], axis=1)
    for _ in range(PASSES):
        reach = thickness[ends] + span[:, None]
        np.minimum.at(thickness, ends[:, 0], reach[:, 1])
        np.minimum.at(thickness, ends[:, 1], reach[:, 0])
    return thickness
