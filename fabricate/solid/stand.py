"""A stand: a round plate under the sculpture, and feet that join it to the part which has the lowest point.

The plate lies lower than everything else by the clearance. Feet go up from it into the middles of the walls, at the
widest places of the part's region that are low and face down, so that they stay away from the other part.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from manifold3d import Manifold

from fabricate.arrays import Floats
from fabricate.errors import SolidError
from fabricate.solid.booleans import Cylinder, bar, manifold_of, united
from fabricate.solid.part import Part, joined
from fabricate.solid.room import Places
from fabricate.solid.sound_turn import Turned, soundly_turned
from fabricate.triangles.adjacency import undirected_edges
from fabricate.triangles.ray_casting import first_hits

LEAST_GAP = 0.3
"""Least distance of the stand from what it does not belong to, mm, where the clearance is less."""

ROUNDED, ADVISED = 0.002, 0.01
"""By how much a plate is thicker than it has to be, for what rounding to float32 takes; heights advised are multiples
of the second; mm."""

WITHIN = 0.3
"""How far feet stay within the walls of their own part that face others, mm: a top that stands out is a thin ledge."""

LEAST_FOOT, MOST_FEET = 1.0, 8
"""Smallest radius of a foot, mm, and how many there are at most."""

WIDE = 0.7
"""Feet at least this share as wide as the widest are chosen by how far they stand from each other."""

LOW = (0.05, 0.1, 0.2)
"""Up to which shares of the sculpture's height feet may reach; the first with room for any is taken."""

FACING_DOWN = -0.7
"""Largest z of the outward normals over feet."""

KEPT = 0.99
"""Share of the gap that feet must keep."""

INTO_WALL, LEVEL = 0.5, 0.5
"""How far a foot goes into the wall over it, and how much its top may tilt, in thicknesses of the wall."""

TILT = 15.0
"""By how many degrees the stand may be tilted before the sculpture falls over, at least."""

ALONG = np.linspace(0.0, 1.0, 9)
"""Where edges of other parts are looked at, from end to end; those of walls lean."""

ROUNDNESS = 1.01
"""How much farther than a foot's radius its corners may be, and walls nearer than where they are measured."""


class Stand(NamedTuple):
    """A round plate and the feet on it, upright bars, united with the part of this name; `height` in mm."""

    part: str
    height: float
    plate: Cylinder
    feet: tuple[Cylinder, ...]


def placed_stand(
    parts: Sequence[Part], places: Places, *, height: float, clearance: float, wall: float, tolerance: float
) -> Stand:
    """Plan a stand that lifts the sculpture by `height`, for all parts; lengths in mm.

    Its plate is at least `wall` thick, and keeps the clearance from what is above it, 0.3 mm at least. Feet keep 0.3 mm
    more than the clearance from other parts.

    Raises
    ------
    SolidError
        If the height leaves no plate, or the part with the lowest point has no room for a foot.
    """
    gap = max(clearance, LEAST_GAP)
    least = math.ceil((gap + wall + ROUNDED) / ADVISED) * ADVISED
    if height < gap + wall + ROUNDED:
        raise SolidError(
            f"a stand {height:g} mm high has no room for a plate of {wall:g} mm and a gap of {gap:g} mm above it; "
            f"ask for solid.base.height of at least {least:.6g} mm"
        )
    lowest = [float(part.points[:, 2].min()) for part in parts]
    own = int(np.argmin(lowest))
    bottom = min(lowest) - height
    others = joined("others", [*parts[:own], *parts[own + 1 :]])
    away = clearance + WITHIN
    feet = _feet(parts[own], others, _low(places, part=own), bottom=bottom, gap=away)
    feet = _kept_away(feet, manifold_of(others), gap=away, tolerance=tolerance)
    if not feet:
        raise SolidError(
            f"{parts[own].name}, which has the lowest point, has no place near the bottom that faces down and is wide "
            f"enough for a foot of {2 * LEAST_FOOT:g} mm; turn the sculpture, or ask for another pattern.seed or a "
            "larger pattern.tile_size"
        )
    return Stand(parts[own].name, height, _plate(parts, feet, bottom, bottom + height - gap), feet)


def _low(places: Places, *, part: int) -> Places:
    return places.chosen((places.part == part) & (places.normals[:, 2] < FACING_DOWN))


def _feet(part: Part, others: Part, places: Places, *, bottom: float, gap: float) -> tuple[Cylinder, ...]:
    """Return upright bars from the bottom into the walls over the low places."""
    heights = np.concatenate([part.points[:, 2], others.points[:, 2]])
    for share in LOW:
        spots = places.chosen(places.points[:, 2] < heights.min() + share * np.ptp(heights))
        feet = _spread(_bars(part, others, spots, bottom=bottom, gap=gap))
        if feet:
            break
    return feet


def _bars(part: Part, others: Part, spots: Places, *, bottom: float, gap: float) -> list[Cylinder]:
    if not len(spots.points):
        return []
    begin = np.column_stack([spots.points[:, :2], np.full(len(spots.points), bottom)])
    up = np.broadcast_to([0.0, 0.0, 1.0], begin.shape)
    face = first_hits(part.points, part.triangles, begin, up).distance
    at_face = np.abs(bottom + face - spots.points[:, 2]) < LEAST_FOOT
    face = np.where(at_face, face, 0.0)
    start = begin + (face + 1e-3)[:, None] * up
    wall = first_hits(part.points, part.triangles, start, up).distance
    length = face + INTO_WALL * np.where(np.isfinite(wall), wall, 0.0)
    slope = np.linalg.norm(spots.normals[:, :2], axis=1) / -spots.normals[:, 2]
    room = _room(others, begin, bottom + length + gap)
    radius = np.minimum((room - gap) / ROUNDNESS, LEVEL * wall / np.maximum(slope, 1e-9))
    standing = at_face & np.isfinite(wall) & (radius >= LEAST_FOOT)
    return [Cylinder(begin[k], begin[k] + length[k] * up[k], float(radius[k])) for k in np.flatnonzero(standing)]


def _room(others: Part, spots: Floats, heights: Floats) -> Floats:
    """Return how far, seen from above, other parts are from each place, (k,) mm; only what is lower than a height."""
    low = others.triangles[(others.points[others.triangles, 2] < heights.max()).any(axis=1)]
    ends = others.points[undirected_edges(low)]
    places = np.concatenate([ends[:, 0] + share * (ends[:, 1] - ends[:, 0]) for share in ALONG])
    room = np.full(len(spots), np.inf)
    for k, (spot, height) in enumerate(zip(spots, heights, strict=True)):
        beside = places[places[:, 2] < height, :2]
        room[k] = np.sqrt(np.square(beside - spot[:2]).sum(axis=1).min(initial=np.inf))
    return room


def _spread(feet: Sequence[Cylinder]) -> tuple[Cylinder, ...]:
    """Return feet that stand apart: the widest, then always the one farthest from those before among the wide ones."""
    widest = max((foot.radius for foot in feet), default=0.0)
    left = sorted((foot for foot in feet if foot.radius >= WIDE * widest), key=lambda foot: -foot.radius)
    kept: list[Cylinder] = []
    while left and len(kept) < MOST_FEET:
        kept.append(max(left, key=lambda foot: _nearest(foot, kept)) if kept else left[0])
        left = [foot for foot in left if _nearest(foot, kept) > LEAST_GAP]
    return tuple(kept)


def _nearest(foot: Cylinder, others: Sequence[Cylinder]) -> float:
    """Return how wide the space is between a foot and the nearest of others, mm; negative where they meet."""
    return min(float(np.linalg.norm(foot.begin - each.begin)) - foot.radius - each.radius for each in others)


def _plate(parts: Sequence[Part], feet: Sequence[Cylinder], bottom: float, top: float) -> Cylinder:
    """Return the plate under the centre of mass: under all feet, and so wide that the sculpture stands safely."""
    masses = [(solid.volume(), _centroid(part)) for part in parts for solid in [manifold_of(part)]]
    centre = sum(volume * place for volume, place in masses) / sum(volume for volume, _ in masses)
    begin = np.array([*centre[:2], bottom])
    reach = max(float(np.linalg.norm(foot.begin - begin)) + foot.radius for foot in feet)
    radius = max(reach, float(np.tan(np.radians(TILT))) * float(centre[2] - bottom))
    return Cylinder(begin, np.array([*centre[:2], top]), radius)


def _centroid(part: Part) -> Floats:
    """Return a closed part's centre of mass, (3,) mm."""
    corners = part.points[part.triangles]
    volumes = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
    centroid: Floats = np.einsum("i,ij->j", volumes, corners.sum(axis=1)) / (4.0 * volumes.sum())
    return centroid


def _kept_away(feet: Sequence[Cylinder], others: Manifold, *, gap: float, tolerance: float) -> tuple[Cylinder, ...]:
    """Return the feet, those that are nearer to other parts than the gap thinner by what is missing, or left out."""
    kept = []
    for foot in feet:
        thinner = foot
        while thinner.radius >= LEAST_FOOT:
            missing = gap - bar(thinner, tolerance=tolerance).min_gap(others, gap)
            if missing <= (1.0 - KEPT) * gap:
                kept.append(thinner)
                break
            thinner = thinner._replace(radius=thinner.radius - missing)
    return tuple(kept)


def stand_solid(stand: Stand, *, tolerance: float, turn: float = 0.0) -> Manifold:
    """Return the plate with its feet, as round as the chord error, mm, asks for; each turned by some degrees."""
    return united([bar(each, tolerance=tolerance, turn=turn) for each in (stand.plate, *stand.feet)])


def standing(part: Part, stand: Stand, *, tolerance: float) -> Turned:
    """Return the part united with the stand, and the stand's turn; other parts as they are.

    Each foot but the first closes a loop through plate and part, which is a handle.

    Raises
    ------
    SolidError
        If the part does not stay sound at any turn of the stand's bars.
    """
    if part.name != stand.part:
        return Turned(part, 0.0)
    return soundly_turned(
        part,
        lambda solid, turn: solid + stand_solid(stand, tolerance=tolerance, turn=turn),
        advice="ask for another solid.base.height or pattern.seed",
    )
