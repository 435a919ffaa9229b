"""Clearance: how far each part's own copy of a curve moves aside, along the rays of the tiles.

Facing walls end up `clearance` apart when the copy of the part on the left of the curve moves to the left and the other
one to the right, half of it each, measured across the curve. Yellow and blue have room as far as the rays go, a band as
far as its middle. Where one side has little room, the other gives more. Where the copies still come too
near each other, as in the bends of small or slanted tiles, they are pushed further until they do not. Moving along rays
keeps every point on the surface and can't fold it (see `surface.template`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.errors import SolidError
from fabricate.region_names import region_names
from fabricate.surface.cut import CutSurface
from fabricate.surface.neck import band_widths, tile_areas, tile_necks
from fabricate.triangles.normals import unit

ROOMY = 2.0
"""A side at least this many clearances wide gives its half."""

FARTHEST = 0.95
"""The largest share of its ray that a copy moves."""

REFUSED = 0.25
"""Share of the surface whose necks must not be wholly taken by the clearance."""

STEEPEST = 0.3
"""Smallest cosine between a ray and the way straight across the curve that is made up for."""

LEAST_UPRIGHT = 0.5
"""Smallest cosine of a leaning wall that is made up for."""

WANTED = 1.0
"""Share of the clearance below which two copies are pushed further apart."""

ROUNDS, PUSH = 12, 1.2
"""Rounds of measuring and pushing, and by how much a push lengthens the way."""

REACH = 6
"""How many points up and down the curve copies are compared."""

SMOOTHING = 4
"""Passes over values along the curve, so that they change gently."""


class RaySides(NamedTuple):
    """The half-rays on either side of a curve, each from the curve outwards, (c, l + 1, 3) float, mm."""

    left: Floats
    right: Floats


class Shares(NamedTuple):
    """How much of its half-ray each copy of a curve moves along, between 0 and 0.95, (c,) float."""

    left: Floats
    right: Floats


def check_necks(surface: CutSurface, *, clearance: float) -> None:
    """Raise an error if the clearance, mm, leaves nothing of the necks on a quarter of the surface.

    Or nothing of a band in a quarter of the tiles.

    Half of the tiles are joined by either colour, so that is about half of the narrower colour's necks. Tiles count by
    their area: many small ones on a thin handle are no reason to refuse the body that it is on.

    Raises
    ------
    SolidError
    """
    neck = narrow_neck(surface)
    if clearance >= neck:
        raise SolidError(
            f"a clearance of {clearance:g} mm leaves nothing of the necks on a quarter of the surface, which are at "
            f"most {neck:.3g} mm wide; ask for a smaller solid.clearance, a larger pattern.tile_size "
            "or a pattern.arc nearer to 0.5"
        )
    names = region_names(len(surface.rings) + 1)[1:-1]
    for name, spacing, (widths, _) in zip(names, np.diff(surface.rings), band_widths(surface), strict=True):
        width = float(np.quantile(widths, 0.25))
        if clearance >= width:
            raise SolidError(
                f"a clearance of {clearance:g} mm leaves nothing of {name} in a quarter of the tiles, where it is at "
                f"most {width:.3g} mm wide; ask for a smaller solid.clearance, a larger pattern.tile_size or "
                f"pattern.rings that are more than {spacing * clearance / width:.3g} apart there, not {spacing:.3g}"
            )


def narrow_neck(surface: CutSurface) -> float:
    """Return the width, mm, that the necks on a quarter of the surface do not have."""
    necks, areas = tile_necks(surface)[0], tile_areas(surface)
    order = np.argsort(necks)
    covered = np.cumsum(areas[order])
    return float(necks[order][np.searchsorted(covered, REFUSED * covered[-1])])


def ray_sides(surface: CutSurface, points: Floats) -> tuple[RaySides, ...]:
    """Return the half-rays through the points of each curve when the surface's points lie at `points`, (n, 3)."""
    return tuple(RaySides(points[left], points[right]) for left, right in surface.half_rays)


def clearance_shares(sides: RaySides, normals: Floats, down: Floats, *, clearance: Floats) -> Shares:
    """Return how far to move both copies of a curve, for the clearance at each of its points, (c,) mm.

    `normals` and `down`, (c, 3), are unit vectors at the curve's points: the surface's, and the way the wall
    goes from there. Where even the farthest move is not enough, the gap stays smaller; the tests of the
    parts find it.
    """
    wanted = clearance / _uprightness(sides.left[:, 0], normals, down)
    lengths = [half_length(side) for side in sides]
    slants = _slants(sides, normals)
    room = np.maximum(np.stack([length * slant for length, slant in zip(lengths, slants, strict=True)]), 1e-9)
    crowded = np.clip(ROOMY - room.min(axis=0) / wanted, 0.0, 1.0)
    part = smoothed(0.5 + crowded * (room[0] / room.sum(axis=0) - 0.5))
    way = wanted * np.stack([part, 1.0 - part]) / room
    suspects = np.arange(len(normals))
    copies = np.empty_like(normals), np.empty_like(normals)
    for _ in range(ROUNDS):
        shares = Shares(*np.minimum(way, FARTHEST))
        for copy, moved in zip(copies, moved_copies(sides, shares, suspects), strict=True):
            copy[suspects] = moved
        near = too_near(copies, WANTED * wanted, suspects=suspects) & (way < FARTHEST).any(axis=0)
        if not near.any():
            break
        pushed = smoothed(near.astype(np.float64))
        way = way * (1.0 + (PUSH - 1.0) * np.minimum(2.0 * pushed, 1.0))
        suspects = np.flatnonzero(pushed)
    return shares


def _uprightness(curve: Floats, normals: Floats, down: Floats) -> Floats:
    """Return the cosine by which walls that lean across the curve are nearer than their copies of the curve."""
    tangent = unit(np.roll(curve, -1, axis=0) - np.roll(curve, 1, axis=0))
    lean = np.einsum("ij,ij->i", down, np.cross(normals, tangent))
    return smoothed(np.sqrt(np.maximum(1.0 - lean**2, LEAST_UPRIGHT**2)))


def shifted(shares: Shares, sides: RaySides, normals: Floats, *, aside: Floats) -> Shares:
    """Return the shares of two copies that have both moved aside along their rays, to the right, by (c,) mm across.

    `normals` are the surface's at the curve's points. A copy that has moved beyond the curve has a negative share: of
    the half-ray on the curve's other side, which may lead across at another slant.
    """
    pairs = zip(sides, _slants(sides, normals), strict=True)
    left, right = (half_length(side) * slant for side, slant in pairs)
    from_left, from_right = shares.left * left - aside, shares.right * right + aside
    moved = (from_left / np.where(from_left < 0.0, right, left), from_right / np.where(from_right < 0.0, left, right))
    return Shares(*(np.clip(each, -FARTHEST, FARTHEST) for each in moved))


def along(side: Floats, shares: Floats) -> Floats:
    """Return the points at the given shares of the length of each half-ray; (c, k) shares give (c, k, 3)."""
    steps = np.linalg.norm(np.diff(side, axis=1), axis=2)
    reached = np.concatenate([np.zeros((len(side), 1)), np.cumsum(steps, axis=1)], axis=1)
    wanted = shares * reached[:, -1:]
    result = np.repeat(side[:, :1], shares.shape[1], axis=1)
    for k in range(steps.shape[1]):
        part = np.clip((wanted - reached[:, k : k + 1]) / np.maximum(steps[:, k : k + 1], 1e-12), 0.0, 1.0)
        result += part[:, :, None] * (side[:, None, k + 1] - side[:, None, k])
    return result


def half_length(side: Floats) -> Floats:
    """Return the length of each half-ray, (c,) float, mm."""
    length: Floats = np.linalg.norm(np.diff(side, axis=1), axis=2).sum(axis=1)
    return length


def _slants(sides: RaySides, normals: Floats) -> tuple[Floats, Floats]:
    """Return for each side the smaller cosine between its rays and the conormals of the neighbouring segments."""
    curve = sides.left[:, 0]
    after = unit(np.cross(normals, np.roll(curve, -1, axis=0) - curve))
    before = unit(np.cross(normals, curve - np.roll(curve, 1, axis=0)))
    slants = []
    for side, sign in ((sides.left, 1.0), (sides.right, -1.0)):
        first = sign * unit(side[:, 1] - side[:, 0])
        cosine = np.minimum(np.einsum("ij,ij->i", first, after), np.einsum("ij,ij->i", first, before))
        slants.append(np.clip(cosine, STEEPEST, 1.0))
    return slants[0], slants[1]


def moved_copies(sides: RaySides, shares: Shares, numbers: Indices) -> tuple[Floats, Floats]:
    """Return where the left and the right part's copies of some curve points come to lie, (k, 3) float each, mm."""
    left, right = (along(side[numbers], share[numbers, None])[:, 0] for side, share in zip(sides, shares, strict=True))
    return left, right


def too_near(copies: tuple[Floats, Floats], least: Floats, *, suspects: Indices) -> Mask:
    """Return at which of the suspected curve points, or midway to the next, the copies are nearer than `least`.

    Each copy is compared with the other one's pieces a few points up and down the curve; what else may come
    near is for the tests of the parts to find.
    """
    count = len(copies[0])
    window = (suspects[:, None] + np.arange(-REACH, REACH + 2)) % count
    near: Mask = np.zeros(count, dtype=bool)
    for own, other in (copies, copies[::-1]):
        pieces = other[window]
        middle = 0.5 * (own[suspects] + own[(suspects + 1) % count])
        at_point, at_middle = (_nearest(query, pieces) < least[suspects] for query in (own[suspects], middle))
        near[suspects[at_point]] = True
        near[suspects[at_middle]] = True
        near[(suspects[at_middle] + 1) % count] = True
    return near


def _nearest(queries: Floats, chains: Floats) -> Floats:
    """Return the distance of each query, (k, 3), to its own chain of straight pieces, (k, p, 3)."""
    along_piece = np.diff(chains, axis=1)
    to_query = queries[:, None] - chains[:, :-1]
    length = np.maximum(np.einsum("ijk,ijk->ij", along_piece, along_piece), np.finfo(float).tiny)
    part = np.clip(np.einsum("ijk,ijk->ij", to_query, along_piece) / length, 0.0, 1.0)
    away = to_query - part[:, :, None] * along_piece
    nearest: Floats = np.sqrt(np.einsum("ijk,ijk->ij", away, away).min(axis=1))
    return nearest


def smoothed(values: Floats) -> Floats:
    """Return the values along the closed curve, averaged with their neighbours a few times."""
    for _ in range(SMOOTHING):
        values = 0.5 * values + 0.25 * (np.roll(values, 1) + np.roll(values, -1))
    return values
