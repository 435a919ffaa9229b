r"""Joints: how the facing walls of two parts run from the outer surface to the inner one.

A straight wall goes straight down. A draft leans: with depth it moves aside, into the region on the curve's right, so
that the part on the left gets wider inside. A tongue gives the wall of the left part a rounded ridge at mid-thickness,
and that of the right part the groove for it:

      left | | right        left  \ \  right        left | | right
           | |                     \ \                   \ \__
           | |                      \ \                   |  _|  the gap between them is as wide as the clearance
           | |                       \ \                 / /     everywhere
         straight                   draft               tongue

Both walls move alike, along the rays of the tiles. Where there is little room beside the curve, or the wall is thinner,
they move less.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.config.solid_config import WIDEST_TONGUE
from fabricate.errors import SolidError
from fabricate.solid.clearance import half_length
from fabricate.solid.layers import Layer
from fabricate.surface.cut import CutSurface, HalfRays
from fabricate.triangles.normals import unit, vertex_normals

JointKind: TypeAlias = Literal["straight", "draft", "tongue"]

RIDGE = ((-0.5, 0.0), (-0.15, 0.8), (0.0, 1.0), (0.15, 0.8), (0.5, 0.0))
"""The rounded ridge, from the outside in: places across it, in widths from its middle, and heights there."""

_SLOPES = np.diff(np.array(RIDGE)[:, 1]) / np.diff(np.array(RIDGE)[:, 0])
_SIDE = float(np.abs(_SLOPES).max())

OWN_WIDTH = (0.6, WIDEST_TONGUE)
"""Width of a ridge for which none is asked, as a share of the wall's thickness, from a low one to a tall one."""

OWN_HEIGHT, MORE_THAN_CLEARANCE = 0.4, 0.15
"""Height of a ridge for which none is asked, where it fits: this, or so much more than the clearance; mm."""

OWN_ANGLE = 3.0
"""How far a draft leans for which no angle is asked, where it fits, degrees."""

LEAST_HEIGHT, HOLDS = 0.1, 0.05
"""A ridge for which no height is asked is at least so high, and by so much higher than the clearance, or it would pass
through the gap; mm."""

STEEPEST = np.radians(41.0)
"""Largest angle of a ridge's sides to the wall: beside a groove whose sides are steeper are lips as thin as walls."""

LEAST_STEP = 0.2
"""Pieces of the ridge's profile must not shrink to less than this share, on the side of the wall on which they do."""

HALVINGS = 12
"""How often the range of heights is halved to find the tallest ridge."""

TAPER = 0.12
"""By how much the way aside changes at most for each mm along the curve: walls at a slant are nearer to each other."""

MOST_ASIDE = 0.75
"""How far walls move aside at most, as a share of the room beside the curve; half of the clearance is taken off it."""

NECK_SPARE = 1.15
"""Necks are left wider by this factor than they have to be: at a slant they are narrower than rays say."""

FITS_IN = 0.9
"""A joint must have room beside this share of the curve; in the rest it is smaller."""

LEAST_SLANT = 0.5
"""Smallest cosine between a ray and the way straight across the curve that is made up for."""


@dataclass(frozen=True, kw_only=True)
class Joint:
    """What kind of joint, and its size.

    Attributes
    ----------
    kind : {"straight", "draft", "tongue"}
    angle : float or None
        By how much a draft leans, degrees; the part on the left gets wider inside, or narrower if it is negative. None
        for what fits.
    height, width : float or None
        How far a tongue's ridge stands out, and how wide it is down the wall, mm; None for what fits.
    neck : float
        Width, mm, that necks have to keep beside the joint.
    """

    kind: JointKind = "straight"
    angle: float | None = None
    height: float | None = None
    width: float | None = None
    neck: float = 0.0

    @property
    def slope(self) -> float:
        """How far a draft moves aside for each mm of depth."""
        return float(np.tan(np.radians(self.angle or 0.0))) if self.kind == "draft" else 0.0


STRAIGHT = Joint()


class _Beside(NamedTuple):
    """The surroundings of one curve at one depth of the wall.

    way : (c, 3) float, unit, along the rays from left to right; stretch : (c,) float, how far to go along them for each
    mm across the curve; left, right : (c,) float, room across the curve on either side, mm.
    """

    way: Floats
    stretch: Floats
    left: Floats
    right: Floats


class _Place(NamedTuple):
    """The room for a ridge along one curve.

    beside : _Beside, halfway down the wall; depth, width : (c,) float, of the wall and of the ridge in it, mm;
    tallest : (c,) float, how high a ridge of that width may be, mm.
    """

    beside: _Beside
    depth: Floats
    width: Floats
    tallest: Floats


def fitted_joint(surface: CutSurface, inner: Floats, joint: Joint, *, thickness: float, clearance: float) -> Joint:
    """Return the joint with its sizes, chosen where none are asked for, for walls at least `thickness` mm thick.

    Raises
    ------
    SolidError
        If it fits neither the walls nor beside the curves; with the largest size that fits.
    """
    if joint.kind == "tongue":
        return _fitted_tongue(surface, inner, joint, thickness=thickness, clearance=clearance)
    if joint.kind == "draft":
        return _fitted_draft(surface, inner, joint, clearance=clearance)
    return joint


def _fitted_tongue(surface: CutSurface, inner: Floats, joint: Joint, *, thickness: float, clearance: float) -> Joint:
    widest = WIDEST_TONGUE * thickness
    if joint.width is not None and joint.width > widest:
        raise SolidError(
            f"a tongue {joint.width:g} mm wide does not fit into a wall of {thickness:g} mm; the largest "
            f"solid.tongue.width that fits is {_floored(widest):g} mm"
        )
    if joint.height is None:
        return _own_tongue(surface, inner, joint, clearance=clearance)
    width = _width(surface, inner, joint, clearance=clearance)
    places = _places(surface, surface.points, inner, joint, widest=width, clearance=clearance)
    fits = _floored(float(np.quantile(np.concatenate([place.tallest for place in places]), 1.0 - FITS_IN)))
    if joint.height > fits:
        raise SolidError(
            f"a tongue that stands out by {joint.height:g} mm does not fit beside the curve and into the wall; the "
            f"largest solid.tongue.height that fits is {fits:g} mm: ask for that, a larger pattern.tile_size, a wider "
            "tongue or a smaller solid.clearance"
        )
    return replace(joint, width=width)


def _width(surface: CutSurface, inner: Floats, joint: Joint, *, clearance: float) -> float:
    """Return the width of a ridge, mm; where none is asked, one whose sides are not too steep for its own height.

    It is one for the wall that half of the curves have: where that is thinner, the ridge is smaller.
    """
    if joint.width is not None:
        return joint.width
    depth = float(np.median(np.linalg.norm(inner - surface.points, axis=1)[surface.curves]))
    least, most = (share * depth for share in OWN_WIDTH)
    return float(np.clip(_own_height(clearance) * _SIDE / np.tan(STEEPEST), least, most))


def _own_height(clearance: float) -> float:
    return max(OWN_HEIGHT, clearance + MORE_THAN_CLEARANCE)


def _least_height(clearance: float) -> float:
    return max(LEAST_HEIGHT, clearance + HOLDS)


def _own_tongue(surface: CutSurface, inner: Floats, joint: Joint, *, clearance: float) -> Joint:
    """Return the tongue with a height where none is asked for, which most of the curve has room for."""

    def fitting(gap: float) -> Joint:
        width = _width(surface, inner, joint, clearance=gap)
        places = _places(surface, surface.points, inner, joint, widest=width, clearance=gap)
        fits = float(np.median(np.concatenate([place.tallest for place in places])))
        return replace(joint, height=_floored(min(fits, _own_height(gap))), width=width)

    def holds(gap: float) -> bool:
        return (fitting(gap).height or 0.0) >= _floored(_least_height(gap))

    if holds(clearance):
        return fitting(clearance)
    smaller = 0.01 * np.arange(math.ceil(100.0 * clearance - 1e-9))
    would = int(bisect_left(smaller, True, key=lambda gap: not holds(gap)))
    largest = f"the largest solid.clearance with which one fits is {smaller[would - 1]:.2g} mm: ask for that, or for "
    raise SolidError(
        f"no tongue fits beside the curve: there is room for {fitting(clearance).height:g} mm, and to hold it has to "
        f"stand out by {_least_height(clearance):g} mm; {largest if would > 1 else 'ask for '}"
        "a larger pattern.tile_size or a thicker wall"
    )


def _fitted_draft(surface: CutSurface, inner: Floats, joint: Joint, *, clearance: float) -> Joint:
    depth = np.linalg.norm(inner - surface.points, axis=1)[surface.curves]
    limits = np.stack(_limits(surface, inner, joint, clearance=clearance))
    steepest = np.degrees(np.arctan(limits / np.maximum(depth, 1e-9)))
    if joint.angle is None:
        return replace(joint, angle=min(OWN_ANGLE, _floored(float(np.median(steepest)), places=1)))
    fits = _floored(float(np.quantile(steepest, 1.0 - FITS_IN)), places=1)
    if abs(joint.angle) > fits:
        raise SolidError(
            f"walls that lean by {joint.angle:g} degrees do not fit beside the curve; the largest solid.draft that "
            f'fits is "{math.copysign(fits, joint.angle):g} deg": ask for that, a larger pattern.tile_size, a thinner '
            "wall or a smaller solid.clearance"
        )
    return joint


def _floored(size: float, *, places: int = 2) -> float:
    """Return the size with a few decimals, never more than it is."""
    return float(math.floor(size * 10**places + 1e-9) / 10**places)


def asides(surface: CutSurface, inner: Floats, joint: Joint, *, clearance: float) -> tuple[Floats, ...]:
    """Return how far each curve's walls move aside, to the right, down to the points `inner`, (c,) mm across each."""
    depth = np.linalg.norm(inner - surface.points, axis=1)
    limits = _limits(surface, inner, joint, clearance=clearance)
    return tuple(
        np.clip(joint.slope * depth[curve], -limit, limit) for curve, limit in zip(surface.curves, limits, strict=True)
    )


def ridges(
    surface: CutSurface, upper: Layer, lower: Layer, joint: Joint, *, size: Floats, clearance: float
) -> list[Layer]:
    """Return the rings of the walls between two layers, from the outside in; only curves have points there.

    `size`, (k, c) shares, makes the ridge lower along each curve.
    Of a joint without a ridge there are none. The left walls' rings are half of the clearance, mm, to one side of the
    ridge's profile and the right walls' to the other: parallels of it.
    """
    if joint.kind != "tongue" or joint.height is None or joint.width is None:
        return []
    outer, under = (np.mean(each.copies, axis=0) for each in (upper, lower))
    rings = [tuple(np.zeros_like(copy) for copy in upper.copies) for _ in RIDGE]
    places = _places(surface, outer, under, joint, widest=joint.width, clearance=clearance)
    for number, (curve, place) in enumerate(zip(surface.curves, places, strict=True)):
        height = size[number] * np.minimum(joint.height * place.width / joint.width, place.tallest)
        offsets = _offsets(height / np.maximum(place.width, 1e-9))
        for ring, (across, out), (aside, deeper) in zip(rings, RIDGE, offsets, strict=True):
            for region, half in ((number, -0.5 * clearance), (number + 1, 0.5 * clearance)):
                above, below = upper.copies[region][curve], lower.copies[region][curve]
                share = (0.5 + (across * place.width + half * deeper) / np.maximum(place.depth, 1e-9))[:, None]
                move = (out * height + half * (aside - 1.0)) * place.beside.stretch
                ring[region][curve] = above + share * (below - above) + move[:, None] * place.beside.way
    return [Layer(ring) for ring in rings]


def _places(
    surface: CutSurface, outer: Floats, under: Floats, joint: Joint, *, widest: float, clearance: float
) -> list[_Place]:
    """Return what room a ridge has along each curve, when the outer and the inner points, (n, 3) mm, are there."""
    above, below = (vertex_normals(points, surface.triangles) for points in (outer, under))
    middle = 0.5 * (outer + under)
    limits = _limits(surface, middle, joint, clearance=clearance)
    places = []
    for curve, beside, limit in zip(surface.curves, _all_beside(surface, middle), limits, strict=True):
        depth = np.linalg.norm(under[curve] - outer[curve], axis=1)
        width = np.minimum(widest, WIDEST_TONGUE * depth)
        down = unit(under[curve] - outer[curve])
        lips = ((above[curve], down), (-below[curve], -down))
        steepest = np.min([_steepest(*lip, beside.way) for lip in lips], axis=0)
        tallest = _tallest(width, depth, steepest, clearance=clearance)
        places.append(_Place(beside, depth, width, tapered(np.minimum(limit, tallest), middle[curve])))
    return places


def _steepest(normals: Floats, inward: Floats, way: Floats) -> Floats:
    """Return the largest slope, (c,), of a groove's sides for which the lips beside it are no thin walls.

    `normals` are the surface's beside the lip, `inward` leads from there into the wall, and `way` across it: all (c, 3)
    unit vectors. A surface that leans over the groove makes the lip sharper.
    """
    over = np.arctan2(np.einsum("ij,ij->i", way, normals), -np.einsum("ij,ij->i", inward, normals))
    slope: Floats = np.tan(np.clip(STEEPEST - over, 0.0, STEEPEST))
    return slope


def _tallest(width: Floats, depth: Floats, steepest: Floats, *, clearance: float) -> Floats:
    """Return how tall a ridge so wide in a wall so deep may be, (c,) mm each, for its parallels not to fold up.

    Nor may its sides have a larger slope than the steepest, (c,).
    """
    low, high = np.zeros_like(width), steepest / _SIDE * width
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        fits = _in_order(middle, width, depth, clearance=clearance)
        low, high = np.where(fits, middle, low), np.where(fits, high, middle)
    return low


def _in_order(height: Floats, width: Floats, depth: Floats, *, clearance: float) -> Mask:
    """Tell where the corners of both parallels of a ridge's profile, (c,) mm each, follow each other down the wall."""
    across = np.array(RIDGE)[:, :1]
    deeper = np.stack([deeper for _, deeper in _offsets(height / np.maximum(width, 1e-9))])
    ends = np.stack([-0.5 * depth, 0.5 * depth])

    def steps(half: float) -> Floats:
        found: Floats = np.diff(np.concatenate([ends[:1], across * width + half * deeper, ends[1:]]), axis=0)
        return found

    asked = steps(0.0)
    in_order: Mask = np.all(
        [steps(half) >= LEAST_STEP * asked for half in (-0.5 * clearance, 0.5 * clearance)], axis=(0, 1)
    )
    return in_order


def _offsets(steepness: Floats) -> list[tuple[Floats, Floats]]:
    """Return for each ring the way to the parallel of the ridge's profile at distance 1: aside and deeper, (c,) each.

    `steepness` is the ridge's height over its width. At a corner of the profile it is the mitre of both sides.
    """
    slopes = np.concatenate([[0.0], _SLOPES, [0.0]])[:, None] * steepness
    normals = np.stack([np.ones_like(slopes), -slopes]) / np.sqrt(1.0 + slopes**2)
    before, after = normals[:, :-1], normals[:, 1:]
    mitres = (before + after) / (1.0 + (before * after).sum(axis=0))
    return list(zip(mitres[0], mitres[1], strict=True))


def _limits(surface: CutSurface, points: Floats, joint: Joint, *, clearance: float) -> list[Floats]:
    """Return how far the walls at each curve may move aside, (c,) mm, when the surface's points lie at `points`.

    They move into the region on the right, or on the left where a draft is negative, and leave half of a neck of it.
    """
    rooms = [beside.left if joint.slope < 0.0 else beside.right for beside in _all_beside(surface, points)]
    limits = [np.minimum(MOST_ASIDE * room, room - 0.5 * NECK_SPARE * joint.neck) - 0.5 * clearance for room in rooms]
    return [tapered(limit, points[curve]) for limit, curve in zip(limits, surface.curves, strict=True)]


def tapered(limits: Floats, curve: Floats, *, taper: float = TAPER) -> Floats:
    """Return the largest limits along a closed curve, (c,) at points (c, 3) mm, that are nowhere above those given.

    Nor do they change by more than `taper` for each mm; none is negative.
    """
    steps = np.linalg.norm(np.roll(curve, -1, axis=0) - curve, axis=1)
    rise = taper * np.concatenate([[0.0], np.cumsum(np.tile(steps, 3))[:-1]])
    least = np.tile(np.maximum(limits, 0.0), 3)
    ahead = np.minimum.accumulate(least - rise) + rise
    behind = (np.minimum.accumulate((least + rise)[::-1]) - rise[::-1])[::-1]
    around: Floats = np.minimum(ahead, behind).reshape(3, -1)[1]
    return np.maximum(around, 0.0)


def _all_beside(surface: CutSurface, points: Floats) -> list[_Beside]:
    normals = vertex_normals(points, surface.triangles)
    pairs = zip(surface.curves, surface.half_rays, strict=True)
    return [_beside(points, normals[curve], curve, half) for curve, half in pairs]


def _beside(points: Floats, normals: Floats, curve: Indices, half: HalfRays) -> _Beside:
    way = unit(points[half.right[:, 1]] - points[half.left[:, 1]])
    tangent = unit(np.roll(points[curve], -1, axis=0) - np.roll(points[curve], 1, axis=0))
    conormal = np.cross(tangent, normals)
    slant = np.clip(np.einsum("ij,ij->i", way, conormal), LEAST_SLANT, 1.0)
    left, right = (slant * half_length(points[side]) for side in half)
    return _Beside(way, 1.0 / slant, left, right)
