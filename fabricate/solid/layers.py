"""Layers: the surfaces that a part is made of, and the closed triangle mesh that joins them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.solid.clearance import Shares, along, clearance_shares, ray_sides
from fabricate.solid.inset import straight_down
from fabricate.surface.cut import CutSurface
from fabricate.triangles.normals import vertex_normals

NEAR = 0.01
"""Depth, mm, down to which an inner layer hugs the outer one; twice as deep it does not any more."""


@dataclass(frozen=True, eq=False)
class Layer:
    """Where the surface's points lie at one depth, once for each part: (n, 3) float, mm.

    The two copies differ by the clearance along the curve, and less and less away from it.
    """

    yellow: Floats
    blue: Floats


def layer_shares(surface: CutSurface, points: Floats, down: Floats, *, clearance: Floats) -> Shares:
    """Return how far the copies of the curve move along their rays to be `clearance` apart, (c,) mm, at `points`.

    `down`, (n, 3), are unit vectors along the wall under each of the points, (n, 3).
    """
    normals = vertex_normals(points, surface.triangles)[surface.curve]
    return clearance_shares(ray_sides(surface, points), normals, down[surface.curve], clearance=clearance)


def shares_near(upper: Shares, lower: Shares, *, nearness: Floats) -> Shares:
    """Return the shares of a lower layer drawn to those of the upper one by its nearness, (c,) from 0 to 1.

    Where two layers lie close together their copies must move alike, or they cut through each other in bends.
    """
    return Shares(*(own + nearness * (above - own) for above, own in zip(upper, lower, strict=True)))


def layer(surface: CutSurface, points: Floats, shares: Shares) -> Layer:
    """Return the two copies of the surface moved to `points`, (n, 3) mm, apart by what the shares say.

    In each copy the curve has moved along its rays, and the rest of the rays has closed up behind it.
    """
    sides = ray_sides(surface, points)
    rays = surface.curve_rays
    middle = rays.shape[1] // 2
    numbers = (rays[:, middle:], rays[:, middle::-1])
    copies = []
    for side, share, number in zip(sides, shares, numbers, strict=True):
        copy = points.copy()
        copy[number] = _closed_up(side, share)
        copies.append(copy)
    return Layer(*copies)


def hugging(surface: CutSurface, upper: Layer, lower: Layer, *, depth: Floats) -> Layer:
    """Return the lower layer with each copy straight under that of the upper one where that is hardly above it.

    Closing up turns triangles, so what is straight under the surface need not be so under its copies. `depth`, (n,)
    mm, is how far the layers are apart.
    """
    near = np.clip(2.0 - depth / NEAR, 0.0, 1.0)[:, None]
    if not near.any():
        return lower
    copies = []
    for above, below, region in (
        (upper.yellow, lower.yellow, surface.yellow),
        (upper.blue, lower.blue, ~surface.yellow),
    ):
        straight = above + depth[:, None] * straight_down(above, surface.triangles[region])
        copies.append(below + near * (straight - below))
    return Layer(*copies)


def _closed_up(side: Floats, share: Floats) -> Floats:
    """Return the half-rays' points, (c, m + 1, 3), moved on so that they begin at `share` of the length."""
    steps = np.linalg.norm(np.diff(side, axis=1), axis=2)
    reached = np.concatenate([np.zeros((len(side), 1)), np.cumsum(steps, axis=1)], axis=1)
    fraction = reached / np.maximum(reached[:, -1:], np.finfo(float).tiny)
    return along(side, share[:, None] + (1.0 - share[:, None]) * fraction)


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
