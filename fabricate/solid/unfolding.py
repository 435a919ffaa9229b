"""Unfolding: copies of a curve move less where closing up the rays behind them would turn triangles over."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.solid.clearance import FARTHEST, Shares, half_length, ray_sides
from fabricate.solid.layers import layer
from fabricate.surface.cut import CutSurface
from fabricate.triangles.normals import area_vectors

ROUNDS, EASE = 8, 0.7
"""Rounds in which a copy moves less where it turns triangles over, and by which factor in each."""


def unfolded(surface: CutSurface, points: Floats, shares: Sequence[Shares]) -> tuple[Shares, ...]:
    """Return the shares of each curve, less where closing up turns triangles over; the other copy moves on instead.

    Where rays lead over a ridge, points of neighbouring ones may come to lie on different sides of it. The surface at
    `points`, (n, 3) mm, has no such place, so moving less cures it.
    """
    facets, sides = area_vectors(points, surface.triangles), ray_sides(surface, points)
    eased = tuple(Shares(left.copy(), right.copy()) for left, right in shares)
    for _ in range(ROUNDS):
        turned = _turned(surface, layer(surface, points, eased).copies, facets)
        if not any(map(len, turned)):
            break
        for number, half_rays in enumerate(surface.half_rays):
            lengths = [half_length(side) for side in sides[number]]
            for own, rays in enumerate(half_rays):
                where = _rays_of(rays, turned[number + own], count=len(points))
                mine, other = eased[number][own], eased[number][1 - own]
                less = (1.0 - EASE) * mine[where]
                mine[where] -= less
                other[where] = np.minimum(other[where] + less * lengths[own][where] / lengths[1 - own][where], FARTHEST)
    return eased


def _turned(surface: CutSurface, copies: Sequence[Floats], facets: Floats) -> list[Indices]:
    """Return for each region the corners, (k,) int, of its triangles that face the other way in its own copy."""
    found = []
    for region, copy in enumerate(copies):
        own = surface.regions == region
        triangles = surface.triangles[own]
        over = np.einsum("ij,ij->i", area_vectors(copy, triangles), facets[own]) < 0.0
        found.append(triangles[over].ravel())
    return found


def _rays_of(rays: Indices, points: Indices, *, count: int) -> Indices:
    """Return which half-rays, (c, l) int, have some of the points, (k,) int, of `count`; not at their fixed ends."""
    chosen = np.zeros(count, dtype=bool)
    chosen[points] = True
    found: Indices = np.flatnonzero(chosen[rays[:, :-1]].any(axis=1))
    return found
