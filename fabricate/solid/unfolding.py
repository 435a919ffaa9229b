"""Unfolding: copies of a curve move less where closing up the rays behind them would turn triangles over."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.solid.clearance import FARTHEST, Shares, half_length, ray_sides
from fabricate.solid.layers import closed_up, layer
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
    lengths = [[half_length(side) for side in each] for each in sides]
    eased = tuple(Shares(left.copy(), right.copy()) for left, right in shares)
    copies = layer(surface, points, eased).copies
    regions = [np.flatnonzero(surface.regions == region) for region in range(len(copies))]
    suspects = regions
    for _ in range(ROUNDS):
        turned = [
            _turned(copy, surface.triangles[own], facets[own]) for copy, own in zip(copies, suspects, strict=True)
        ]
        if not any(map(len, turned)):
            break
        moved = [np.zeros(len(points), dtype=bool) for _ in copies]
        for number, half_rays in enumerate(surface.half_rays):
            rays = []
            for own in (0, 1):
                rays.append(_rays_of(half_rays[own], turned[number + own], count=len(points)))
                _ease(eased[number], lengths[number], rays[own], own=own)
            again = np.unique(np.concatenate(rays))
            for own in (0, 1):
                numbers, (mine, other) = half_rays[own][again], (sides[number][side][again] for side in (own, 1 - own))
                copies[number + own][numbers] = closed_up(mine, other, eased[number][own][again])
                moved[number + own][numbers] = True
        touched = [mine[surface.triangles[own]].any(axis=1) for mine, own in zip(moved, regions, strict=True)]
        suspects = [own[near] for near, own in zip(touched, regions, strict=True)]
    return eased


def _ease(shares: Shares, lengths: Sequence[Floats], rays: Indices, *, own: int) -> None:
    """Let the copy on one side move less on some rays, and the other one on instead."""
    mine, other = shares[own], shares[1 - own]
    less = (1.0 - EASE) * mine[rays]
    mine[rays] -= less
    other[rays] = np.minimum(other[rays] + less * lengths[own][rays] / lengths[1 - own][rays], FARTHEST)


def _turned(copy: Floats, triangles: Indices, facets: Floats) -> Indices:
    """Return the corners, (k,) int, of triangles that face the other way in a region's own copy."""
    over = np.einsum("ij,ij->i", area_vectors(copy, triangles), facets) < 0.0
    corners: Indices = triangles[over].ravel()
    return corners


def _rays_of(rays: Indices, points: Indices, *, count: int) -> Indices:
    """Return which half-rays, (c, l) int, have some of the points, (k,) int, of `count`; not at their fixed ends."""
    chosen = np.zeros(count, dtype=bool)
    chosen[points] = True
    found: Indices = np.flatnonzero(chosen[rays[:, :-1]].any(axis=1))
    return found
