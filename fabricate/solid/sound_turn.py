"""The turn of round bars at which a part that they are added to, or taken from, stays sound as a file holds it.

Where the sides of a bar pass close by a part's corners and edges, triangles can come out so small that rounding to
float32 leaves them without area or lets them cross. Turned about its axis by a little, a bar passes elsewhere.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from manifold3d import Manifold

from fabricate.errors import SolidError
from fabricate.solid.booleans import manifold_of, part_of
from fabricate.solid.part import Part
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.normals import area_vectors

TURNS = (0.0, 1.7, 3.1, 4.9, 6.1, 7.3, 8.9, 10.3)
"""Turns of round bars that are tried, degrees."""


class Turned(NamedTuple):
    """A part with bars added or taken away, and how far they are turned, degrees."""

    part: Part
    turn: float


def soundly_turned(part: Part, change: Callable[[Manifold, float], Manifold], *, advice: str) -> Turned:
    """Return what `change` makes of a part at the first turn of its bars, degrees, that leaves the part sound.

    A part that has faults before is changed at the first turn: it is for the checks to say what is wrong with it.

    Raises
    ------
    SolidError
        If the part is sound, and is so no longer at any of the turns; ends with the advice.
    """
    solid = manifold_of(part)
    for turn in TURNS:
        changed = part_of(part.name, change(solid, turn))
        if is_sound(changed):
            return Turned(changed, turn)
    if is_sound(part):
        raise SolidError(
            f"the round bars that {part.name} is cut or joined with leave triangles that cross or have no area once "
            f"coordinates are rounded, at each of {len(TURNS)} turns tried; {advice}"
        )
    return Turned(part_of(part.name, change(solid, TURNS[0])), TURNS[0])


def is_sound(part: Part) -> bool:
    """Tell whether a part is a closed manifold of triangles with areas that do not cross, as its file will hold it.

    Files name corners by their places alone, so no two points of the part may lie in the same place.
    """
    used = np.unique(part.triangles)
    if not len(used) or len(np.unique(part.points[used], axis=0)) < len(used):
        return False
    if not (area_vectors(part.points, part.triangles) != 0.0).any(axis=1).all():
        return False
    return _is_closed(part) and not len(crossing_triangles(part.points, part.triangles))


def _is_closed(part: Part) -> bool:
    """Tell whether every edge has two triangles, which run along it in opposite directions."""
    begins, ends = part.triangles.ravel(), np.roll(part.triangles, -1, axis=1).ravel()
    there, back = (np.sort(one * len(part.points) + other) for one, other in ((begins, ends), (ends, begins)))
    return bool((np.diff(there) > 0).all() and np.array_equal(there, back))
