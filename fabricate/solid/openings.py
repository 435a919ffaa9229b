"""Openings: round holes through the walls, by which resin and powder leave the hollow inside.

They lie in the middle of the widest places of a region, so they cut no neck. The first is the lowest that has room, and
each of the others is as far from those before as can be, so that one drains while air comes in by another.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from manifold3d import Manifold

from fabricate.arrays import Floats, Indices
from fabricate.errors import SolidError
from fabricate.solid.booleans import Cylinder, bar, united
from fabricate.solid.part import Part, joined
from fabricate.solid.room import Places
from fabricate.solid.sound_turn import Turned, soundly_turned
from fabricate.triangles.ray_casting import first_hits
from fabricate.triangles.search_tree import SearchTree

START = 1e-3
"""How far within a face a ray begins, mm."""

ABOVE = 0.25
"""How far above the smooth surface the wall is looked for, in diameters; its triangles lie a chord error off."""

DOWN = (0.0, 0.25, 0.5, 0.75, 1.0)
"""At which shares of the wall's thickness the room around an opening is measured."""

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

    begin : (k, 3) float, where its outer face is; thickness, hollow, free, room : (k,) float, how thick it is, how deep
    the hollow under it, how far the next thing above it, and how far other parts are from the axis of an opening.
    """

    begin: Floats
    thickness: Floats
    hollow: Floats
    free: Floats
    room: Floats


def placed_openings(
    parts: Sequence[Part], places: Places, *, diameter: float, count: int, clearance: float, rim: float
) -> tuple[Opening, ...]:
    """Find room for `count` openings of a diameter in the parts; all lengths in mm.

    The wall left round an opening is at least `rim` wide, and the hollow under it as deep as the opening's radius.

    Raises
    ------
    SolidError
        If there is no room for as many; says the largest diameter for which there is.
    """
    numbers, openings, largest = _suitable(parts, places, diameter, clearance + rim)
    spots = places.points[numbers]
    if len(numbers) < count:
        found = f"found room for {len(numbers)}" if len(numbers) else "found no room"
        hint = np.sort(largest)[::-1][count - 1 : count]
        fits = f"; the largest that fits is {hint[0]:.3g} mm" if len(hint) and hint[0] > 0.0 else ""
        raise SolidError(
            f"{count} openings of {diameter:g} mm were asked for, which must cut no neck and leave {rim:g} mm of "
            f"wall around, and {found}{fits}; ask for less in solid.openings or for a larger pattern.tile_size"
        )
    return tuple(openings[k] for k in _apart(spots, count))


def _suitable(
    parts: Sequence[Part], places: Places, diameter: float, around: float
) -> tuple[Indices, list[Opening], Floats]:
    """Return the numbers of the places with room, an opening in each, and the largest diameter in every place."""
    numbers, openings, largest = [], [], []
    for number, part in enumerate(parts):
        here = np.flatnonzero(places.part == number)
        spots = places.chosen(here)
        others = joined("others", [*parts[:number], *parts[number + 1 :]])
        wall = _walls(part, others, spots, diameter)
        fits = 2.0 * np.minimum.reduce([wall.room - around, wall.hollow, wall.free / (2.0 * BEYOND)])
        largest.append(fits)
        for k in np.flatnonzero(fits >= diameter):
            numbers.append(here[k])
            way = -spots.normals[k]
            openings.append(Opening(part.name, wall.begin[k], way, diameter, float(wall.thickness[k])))
    return np.array(numbers, dtype=np.int64), openings, np.concatenate(largest)


def _walls(part: Part, others: Part, spots: Places, diameter: float) -> _Wall:
    """Measure under and above some places of a part."""
    inward, above = -spots.normals, ABOVE * diameter
    outside = first_hits(part.points, part.triangles, spots.points - above * inward, inward).distance
    found = outside < 2.0 * above
    faces = spots.points + (np.where(found, outside, above) - above)[:, None] * inward
    under = START + first_hits(part.points, part.triangles, faces + START * inward, inward).distance
    found &= np.isfinite(under)
    thickness = np.where(found, under, 0.0)
    whole = joined("all", [part, others])
    below, above_face = faces + (thickness + START)[:, None] * inward, faces - START * inward
    hollow = first_hits(whole.points, whole.triangles, below, inward).distance
    free = first_hits(whole.points, whole.triangles, above_face, -inward).distance
    tree = SearchTree.of(others.points, others.triangles)
    axis = [faces + share * thickness[:, None] * inward for share in DOWN]
    room = tree.nearest(np.concatenate(axis)).distance.reshape(len(DOWN), -1).min(axis=0)
    return _Wall(faces, thickness, np.where(found, hollow, 0.0), free, room)


def _apart(spots: Floats, count: int) -> list[int]:
    """Return the numbers of spots, (k, 3), far from each other: the lowest, then always the farthest."""
    chosen = [int(spots[:, 2].argmin())]
    distance = np.linalg.norm(spots - spots[chosen[0]], axis=1)
    while len(chosen) < count:
        chosen.append(int(distance.argmax()))
        distance = np.minimum(distance, np.linalg.norm(spots - spots[chosen[-1]], axis=1))
    return chosen


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
