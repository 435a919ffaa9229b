"""Openings: round holes through the walls, by which resin and powder leave the hollow inside.

They lie in the middle of the widest places of a region, so they cut no neck. The first is the lowest that has room, and
each of the others is as far from those before as can be, so that one drains while air comes in by another.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from manifold3d import Manifold

from fabricate.arrays import Floats
from fabricate.errors import SolidError
from fabricate.solid.booleans import Cylinder, bar, united
from fabricate.solid.part import Part, joined
from fabricate.solid.room import Places
from fabricate.solid.sound_turn import Turned, soundly_turned
from fabricate.triangles.normals import unit
from fabricate.triangles.ray_casting import first_hits
from fabricate.triangles.search_tree import SearchTree

START = 1e-3
"""How far within a face a ray begins, mm."""

ABOVE = 0.25
"""How far above the smooth surface the wall is looked for, in diameters; its triangles lie a chord error off."""

DOWN = np.linspace(-0.25, 1.25, 13)
"""At which shares of the wall's thickness the room around an opening is measured; walls that bend reach beyond."""

OUT = np.linspace(0.0, 1.0, 5)
"""At which distances before an opening, in diameters, the way out of it is looked at."""

ROUNDNESS = 1.01
"""How much farther than its radius a round bar's corners may be, and joints nearer than where they are measured."""

SMALLEST, TRIALS, SMALLER = 0.1, 20, 0.95
"""Smallest diameter that is advised, mm; how often one is tried for advice, and by how much it gets smaller."""

BEYOND = 1.0
"""How far an opening goes on beyond both faces of the wall, in radii."""


class Opening(NamedTuple):
    """A round hole through the wall of a part: where its axis goes in, (3,) mm, and which way, (3,) unit."""

    part: str
    at: Floats
    way: Floats
    diameter: float
    wall: float

    @property
    def drill(self) -> Cylinder:
        """What is taken away."""
        beyond = 0.5 * BEYOND * self.diameter
        return Cylinder(self.at - beyond * self.way, self.at + (self.wall + beyond) * self.way, 0.5 * self.diameter)


class _Wall(NamedTuple):
    """The wall at some places of one part: all lengths in mm.

    begin, end : (k, 3) float, where its outer and its inner face are; hollow, free, room, unhindered : (k,) float, how
    deep the hollow under it is, how far the next thing above it, how far its joints are from the axis of an opening,
    and how large an opening the stand leaves free.
    """

    begin: Floats
    end: Floats
    hollow: Floats
    free: Floats
    room: Floats
    unhindered: Floats


class _Suitable(NamedTuple):
    """Openings where there is room for them, and the largest diameter at every place, (k,) float, mm."""

    openings: list[Opening]
    largest: Floats


@dataclass(frozen=True, eq=False)
class Drilling:
    """What openings are drilled into.

    Attributes
    ----------
    parts : sequence of Part
    joints : sequence of SearchTree
        Of each part, the walls that face other parts.
    places : Places
        Where openings may be.
    stand : Part or None
        What will stand under the parts.
    """

    parts: Sequence[Part]
    joints: Sequence[SearchTree]
    places: Places
    stand: Part | None = None


def placed_openings(drilling: Drilling, *, diameter: float, count: int, rim: float) -> tuple[Opening, ...]:
    """Find room for `count` openings of a diameter; all lengths in mm.

    The wall left round an opening is at least `rim` wide, and the hollow under it as deep as the opening's radius. As
    far out as the opening is wide nothing lies above it.

    Raises
    ------
    SolidError
        If there is no room for as many; says the largest diameter for which there is.
    """
    suitable = _suitable(drilling, diameter, rim)
    chosen = _apart(suitable.openings, count, rim=rim)
    if len(chosen) < count:
        largest = _largest(drilling, np.minimum(suitable.largest, diameter), count=count, rim=rim)
        asked = f"1 opening of {diameter:g} mm was" if count == 1 else f"{count} openings of {diameter:g} mm were"
        raise SolidError(
            f"{asked} asked for, which must cut no neck and leave {rim:g} mm of wall around, and found "
            f"{f'room for {len(chosen)}' if chosen else 'no room'}"
            f"{f'; the largest that fits is {largest:g} mm' if largest else ''}; ask for less in solid.openings or for "
            "a larger pattern.tile_size"
        )
    return tuple(chosen)


def _largest(drilling: Drilling, largest: Floats, *, count: int, rim: float) -> float | None:
    """Return a diameter for which there is room `count` times, mm, as large as can be; None if there is none."""
    if len(largest) < count:
        return None
    diameter = float(np.sort(largest)[-count])
    for _ in range(TRIALS):
        if diameter < SMALLEST:
            return None
        diameter = _rounded_down(diameter)
        if len(_apart(_suitable(drilling, diameter, rim).openings, count, rim=rim)) == count:
            return diameter
        diameter *= SMALLER
    return None


def _rounded_down(length: float) -> float:
    """Return a positive length with three significant digits, never larger."""
    digit = 10.0 ** (math.floor(math.log10(length)) - 2)
    return float(f"{math.floor(length / digit) * digit:.3g}")


def _suitable(drilling: Drilling, diameter: float, rim: float) -> _Suitable:
    """Return an opening at each place that has room for it, in the order of places."""
    parts, places = drilling.parts, drilling.places
    openings, largest = [], []
    for number, part in enumerate(parts):
        spots = places.chosen(places.part == number)
        wall = _walls(drilling, number, spots, diameter, rim)
        by_joints = 2.0 * (wall.room - rim) / ROUNDNESS
        fits = np.minimum.reduce([by_joints, 2.0 * wall.hollow, wall.free / BEYOND, wall.unhindered])
        largest.append(fits)
        thickness = np.linalg.norm(wall.end - wall.begin, axis=1)
        openings += [
            Opening(part.name, wall.begin[k], -spots.normals[k], diameter, float(thickness[k]))
            for k in np.flatnonzero(fits >= diameter)
        ]
    return _Suitable(openings, np.concatenate(largest))


def _walls(drilling: Drilling, number: int, spots: Places, diameter: float, rim: float) -> _Wall:
    """Measure under and above some places of a part."""
    part, inward, above = drilling.parts[number], -spots.normals, ABOVE * diameter
    outside = first_hits(part.points, part.triangles, spots.points - above * inward, inward).distance
    found = outside < 2.0 * above
    faces = spots.points + (np.where(found, outside, above) - above)[:, None] * inward
    under = START + first_hits(part.points, part.triangles, faces + START * inward, inward).distance
    found &= np.isfinite(under)
    ends = faces + np.where(found, under, 0.0)[:, None] * inward
    whole = joined("all", drilling.parts)
    hollow = first_hits(whole.points, whole.triangles, ends + START * inward, inward).distance
    free = first_hits(whole.points, whole.triangles, faces - START * inward, -inward).distance
    room = _nearest(drilling.joints[number], faces, ends)
    unhindered = _unhindered(drilling.stand, faces, ends, diameter, rim)
    return _Wall(faces, ends, np.where(found, hollow, 0.0), free, room, unhindered)


def _unhindered(stand: Part | None, faces: Floats, ends: Floats, diameter: float, rim: float) -> Floats:
    """Return how large an opening may be that leaves the rim between it and a stand, (k,) float, mm.

    The way out of it is free of the stand for as far as it is wide: at a height h over the face, of all that are
    looked at, either the opening is not as wide as h, or the stand is at least its radius away.
    """
    if stand is None:
        return np.full(len(faces), np.inf)
    tree = SearchTree.of(stand.points, stand.triangles)
    way = unit(faces - ends)
    beside = 2.0 * (_nearest(tree, faces, ends) - rim) / ROUNDNESS
    heights = [share * diameter for share in OUT]
    before = [np.maximum(height, 2.0 * tree.nearest(faces + height * way).distance) for height in heights]
    unhindered: Floats = np.minimum.reduce([beside, *before])
    return unhindered


def _nearest(tree: SearchTree, begins: Floats, ends: Floats) -> Floats:
    """Return how near a mesh comes to the axes of openings through a wall, (k,) float, mm."""
    nearest: Floats = np.min([tree.nearest(begins + down * (ends - begins)).distance for down in DOWN], axis=0)
    return nearest


def _apart(openings: Sequence[Opening], count: int, *, rim: float) -> list[Opening]:
    """Return openings far from each other: the lowest, then always the farthest, while a rim is left between them."""
    if not openings:
        return []
    ends = np.array([[each.at, each.at + each.wall * each.way] for each in openings])
    chosen = [int(ends[:, 0, 2].argmin())]
    distance = np.full(len(ends), np.inf)
    while len(chosen) < count:
        distance = np.minimum(distance, np.linalg.norm(ends - ends[chosen[-1]], axis=2).min(axis=1))
        farthest = int(distance.argmax())
        if distance[farthest] < ROUNDNESS * openings[farthest].diameter + rim:
            break
        chosen.append(farthest)
    return [openings[k] for k in chosen]


def drilled(part: Part, openings: Sequence[Opening], *, tolerance: float) -> Turned:
    """Return the part with holes where its openings are, and their turn; other parts' openings leave it as it is.

    The sides of a hole are as short as the chord error, mm, asks for.

    Raises
    ------
    SolidError
        If the part does not stay sound at any turn of the drills.
    """
    own = [opening for opening in openings if opening.part == part.name]
    if not own:
        return Turned(part, 0.0)
    return soundly_turned(
        part,
        lambda solid, turn: solid - drills(own, tolerance=tolerance, turn=turn),
        advice="ask for another solid.openings.diameter or pattern.seed",
    )


def drills(openings: Sequence[Opening], *, tolerance: float, turn: float = 0.0) -> Manifold:
    """Return all that openings take away, turned about each axis by some degrees."""
    return united([bar(opening.drill, tolerance=tolerance, turn=turn) for opening in openings])
