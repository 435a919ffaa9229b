"""Layers: the surfaces that a part is made of, and the closed triangle mesh that joins them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.solid.clearance import Shares, along, clearance_shares, half_length, ray_sides, shifted
from fabricate.surface.cut import CutSurface
from fabricate.triangles.normals import vertex_normals


@dataclass(frozen=True, eq=False)
class Layer:
    """Where the surface's points lie at one depth, once for each part, by its region: `copies`, (n, 3) float each, mm.

    Copies of neighbouring regions differ by the clearance along the curve between them, and less and less away from it.
    """

    copies: tuple[Floats, ...]


def layer_shares(surface: CutSurface, points: Floats, down: Floats, *, clearance: Floats) -> tuple[Shares, ...]:
    """Return how far the copies of each curve move along their rays to be `clearance` apart, (k, c) mm, at `points`.

    `down`, (n, 3), are unit vectors along the wall under each of the points, (n, 3).
    """
    normals = vertex_normals(points, surface.triangles)
    return tuple(
        clearance_shares(sides, normals[curve], down[curve], clearance=wanted)
        for sides, curve, wanted in zip(ray_sides(surface, points), surface.curves, clearance, strict=True)
    )


def shares_near(upper: Shares, lower: Shares, *, nearness: Floats) -> Shares:
    """Return the shares of a curve on a lower layer drawn to those on the upper one by its nearness, (c,) from 0 to 1.

    Where two layers lie close together their copies must move alike, or they cut through each other in bends.
    """
    return Shares(*(own + nearness * (above - own) for above, own in zip(upper, lower, strict=True)))


def shares_aside(
    surface: CutSurface, points: Floats, shares: Sequence[Shares], *, asides: Sequence[Floats]
) -> tuple[Shares, ...]:
    """Return the shares of each curve at `points`, (n, 3) mm, moved aside along the rays, by (c,) mm across each."""
    normals = vertex_normals(points, surface.triangles)
    curves = zip(shares, ray_sides(surface, points), surface.curves, asides, strict=True)
    return tuple(shifted(own, sides, normals[curve], aside=aside) for own, sides, curve, aside in curves)


def layer(surface: CutSurface, points: Floats, shares: Sequence[Shares]) -> Layer:
    """Return the copies of the surface moved to `points`, (n, 3) mm, apart by what the shares of each curve say.

    In each copy the curves round its region have moved into it along their rays, and the rest of the half-rays has
    closed up behind them.
    """
    copies = tuple(points.copy() for _ in range(len(shares) + 1))
    curves = zip(surface.half_rays, ray_sides(surface, points), shares, strict=True)
    for number, (half_rays, sides, share) in enumerate(curves):
        copies[number][half_rays.left] = closed_up(sides.left, sides.right, share.left)
        copies[number + 1][half_rays.right] = closed_up(sides.right, sides.left, share.right)
    return Layer(copies)


def moved_aside(surface: CutSurface, points: Floats, asides: Sequence[Floats]) -> Floats:
    """Return the points, (n, 3) mm, when each curve moves along its rays, to the right, by (c,) mm across each."""
    moved = points.copy()
    nowhere = [Shares(np.zeros_like(aside), np.zeros_like(aside)) for aside in asides]
    shares = shares_aside(surface, points, nowhere, asides=asides)
    for half_rays, sides, share in zip(surface.half_rays, ray_sides(surface, points), shares, strict=True):
        moved[half_rays.left] = closed_up(sides.left, sides.right, share.left)
        moved[half_rays.right] = closed_up(sides.right, sides.left, share.right)
    return moved


def closed_up(side: Floats, other: Floats, share: Floats) -> Floats:
    """Return the half-rays' points, (c, l + 1, 3), moved on so that they begin at `share` of the length.

    Of a negative share it is the length of the half-ray on the other side, which is entered from the curve.
    """
    steps = np.linalg.norm(np.diff(side, axis=1), axis=2)
    reached = np.concatenate([np.zeros((len(side), 1)), np.cumsum(steps, axis=1)], axis=1)
    fraction = reached / np.maximum(reached[:, -1:], np.finfo(float).tiny)
    if not (share < 0.0).any():
        return along(side, share[:, None] + (1.0 - share[:, None]) * fraction)
    ratio = half_length(other) / np.maximum(reached[:, -1], np.finfo(float).tiny)
    begin = np.where(share < 0.0, share * ratio, share)[:, None]
    shares = begin + (1.0 - begin) * fraction
    beyond = np.maximum(-shares / np.maximum(ratio, np.finfo(float).tiny)[:, None], 0.0)
    return np.where(shares[:, :, None] < 0.0, along(other, beyond), along(side, np.maximum(shares, 0.0)))


def wall(curve: Indices, lower: int, upper: int) -> Indices:
    r"""Return the triangles between two copies of the closed curve, facing right of the curve.

    `upper` and `lower` are added to the curve's numbers for the copy nearer to the outer surface and
    the one further in. Every cell is split along the diagonal from the upper start to the lower end, so
    that walls of different parts that face each other are split alike:

        u0 -->-- u1        outside
        |   \    |
        l0 ------ l1       inside
    """
    here, ahead = curve, np.roll(curve, -1)
    first = np.stack([ahead + upper, here + upper, ahead + lower], axis=1)
    second = np.stack([here + upper, here + lower, ahead + lower], axis=1)
    return np.concatenate([first, second])


def flipped(triangles: Indices) -> Indices:
    """Return the triangles facing the other way."""
    return triangles[:, ::-1]
