"""Places that a fit coupon may show: the narrowest necks, and the bends that are as sharp as most."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from fabricate.arrays import Floats, Indices, Mask, frozen
from fabricate.surface.cut import CutSurface
from fabricate.surface.neck import tile_areas, tile_necks

Kind: TypeAlias = Literal["neck", "bend"]

MOST = 200
"""So many places of each kind are offered."""


@dataclass(frozen=True, eq=False)
class CouponPlace:
    """A place on the joint.

    Attributes
    ----------
    kind : {"neck", "bend"}
    at : (3,) float
        Midway between the two sides of a neck; on the curve, in the middle of a bend; mm.
    along : (3,) float
        The way the curve runs there; not of unit length.
    region : int
        That which is joined by the neck, or lies inside of the bend.
    size : float
        Width of the neck before clearance is taken off, or radius of the bend, mm.
    side : float
        Side of a square as large as the tile, mm.
    """

    kind: Kind
    at: Floats
    along: Floats
    region: int
    size: float
    side: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "at", frozen(self.at, np.float64, (3,)))
        object.__setattr__(self, "along", frozen(self.along, np.float64, (3,)))


def neck_places(surface: CutSurface, joined: Mask) -> tuple[CouponPlace, ...]:
    """Return the narrowest necks, the narrowest first; `joined`, (t,), says which tiles are yellow-joined."""
    widths, middles = tile_necks(surface)
    last = len(surface.rings) - 1
    tiles = np.argsort(widths, kind="stable")[:MOST]
    arcs = surface.points[surface.arcs[np.where(joined, 0, last)[tiles], 2 * tiles]]
    regions = np.where(joined, 0, last + 1)[tiles]
    return _places("neck", surface, 2 * tiles, arcs, at=middles[tiles], regions=regions, sizes=widths[tiles])


def bend_places(surface: CutSurface, joined: Mask) -> tuple[CouponPlace, ...]:
    """Return arcs of tiles whose curvatures are nearest to the median of all, the nearest first.

    The curvature of an arc is that of the circle through its ends and its middle. Of several rings it is the one
    nearest to the corner that the arc goes round, a blue one where the tile is yellow-joined.
    """
    rings = np.where(np.repeat(joined, 2), len(surface.rings) - 1, 0)
    numbers = surface.arcs[rings, np.arange(len(rings))]
    curvature = _curvatures(surface.points[numbers])
    chosen = np.argsort(np.abs(curvature - np.median(curvature)), kind="stable")[:MOST]
    regions = rings[chosen] + ~_turns_left(surface, numbers[chosen])
    radii = 1.0 / np.maximum(curvature[chosen], np.finfo(float).tiny)
    arcs = surface.points[numbers[chosen]]
    return _places("bend", surface, chosen, arcs, at=arcs[:, arcs.shape[1] // 2], regions=regions, sizes=radii)


def _turns_left(surface: CutSurface, arcs: Indices) -> Mask:
    """Tell which arcs, (k, n + 1) point numbers, turn to the left, where the region of the lower number lies."""
    begin, middle, end = arcs[:, 0], arcs[:, arcs.shape[1] // 2], arcs[:, -1]
    chord = surface.points[end] - surface.points[begin]
    inwards = surface.points[begin] + 0.5 * chord - surface.points[middle]
    left: Mask = np.einsum("ij,ij->i", np.cross(surface.normals[middle], chord), inwards) > 0.0
    return left


def _curvatures(arcs: Floats) -> Floats:
    """Return the curvature of each arc, (k, n + 1, 3) points, 1 / mm."""
    begin, middle, end = arcs[:, 0], arcs[:, arcs.shape[1] // 2], arcs[:, -1]
    sides = [np.linalg.norm(q - p, axis=1) for p, q in ((begin, middle), (middle, end), (end, begin))]
    twice_area = np.linalg.norm(np.cross(middle - begin, end - begin), axis=1)
    curvatures: Floats = 2.0 * twice_area / np.prod(sides, axis=0)
    return curvatures


def _places(
    kind: Kind, surface: CutSurface, numbers: Indices, arcs: Floats, *, at: Floats, regions: Indices, sizes: Floats
) -> tuple[CouponPlace, ...]:
    """Return places on the given arcs, (k,) numbers and (k, n + 1, 3) points."""
    middle = arcs.shape[1] // 2
    along = arcs[:, middle + 1] - arcs[:, middle - 1]
    sides = np.sqrt(tile_areas(surface)[numbers // 2])
    return tuple(
        CouponPlace(kind, at[k], along[k], int(regions[k]), float(sizes[k]), float(sides[k]))
        for k in range(len(numbers))
    )
