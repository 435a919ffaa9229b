"""The finish: openings drilled and a stand added when the parts are made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from fabricate.solid.assembly import Assembly
from fabricate.solid.booleans import manifold_of, part_of
from fabricate.solid.openings import Drilling, Opening, drilled, drills, placed_openings
from fabricate.solid.part import Part
from fabricate.solid.room import Places, roomy_places
from fabricate.solid.stand import Stand, placed_stand, stand_solid, standing
from fabricate.surface.cut import CutSurface
from fabricate.triangles.search_tree import SearchTree


@dataclass(frozen=True, kw_only=True)
class FinishWish:
    """What is asked for beside the parts themselves; all lengths in mm.

    Attributes
    ----------
    opening_diameter, opening_count : float and int
        Of the openings; none where the count is 0.
    stand_height : float
        How high the stand is; 0 for none.
    clearance, wall : float
        Gap that the stand keeps from what it does not belong to, and least thickness that is left of anything.
    tolerance : float
        Chord error of round things.
    """

    clearance: float
    wall: float
    tolerance: float
    opening_diameter: float = 0.0
    opening_count: int = 0
    stand_height: float = 0.0


@dataclass(frozen=True, eq=False)
class Finished:
    """Parts that are ready.

    Attributes
    ----------
    parts : tuple of Part
    spaces : (gap, shell)
        The space between the parts, and the uncut whole with the same openings and the same stand.
    openings : tuple of Opening
    stand : Stand or None
    """

    parts: tuple[Part, ...]
    spaces: tuple[Part, Part]
    openings: tuple[Opening, ...] = ()
    stand: Stand | None = None


def finished(surface: CutSurface, made: Assembly, wish: FinishWish) -> Finished:
    """Drill the openings and add the stand that are asked for.

    Raises
    ------
    SolidError
        If there is no room for them, or none at which the parts stay sound; says what to ask for.
    """
    parts = list(made.parts)
    gap, shell = made.spaces
    if not wish.opening_count and not wish.stand_height:
        return Finished(tuple(parts), (gap, shell))
    places, solid = roomy_places(surface), manifold_of(shell)
    stand = _stand(parts, places, wish)
    openings = _openings(surface, made, places, stand, wish)
    for number, part in enumerate(parts):
        own = [opening for opening in openings if opening.part == part.name]
        parts[number], turn = drilled(part, own, tolerance=wish.tolerance)
        solid = solid - drills(own, tolerance=wish.tolerance, turn=turn)
        if stand is not None and part.name == stand.part:
            parts[number], turn = standing(parts[number], stand, tolerance=wish.tolerance)
            solid = solid + stand_solid(stand, tolerance=wish.tolerance, turn=turn)
    return Finished(tuple(parts), (gap, part_of(shell.name, solid)), openings, stand)


def _stand(parts: Sequence[Part], places: Places, wish: FinishWish) -> Stand | None:
    if not wish.stand_height:
        return None
    return placed_stand(
        parts, places, height=wish.stand_height, clearance=wish.clearance, wall=wish.wall, tolerance=wish.tolerance
    )


def _openings(
    surface: CutSurface, made: Assembly, places: Places, stand: Stand | None, wish: FinishWish
) -> tuple[Opening, ...]:
    """Return the openings that are asked for, where neither joints nor the stand are in their way."""
    if not wish.opening_count:
        return ()
    regions = range(len(made.parts))
    joints = [SearchTree.of(made.points, made.joint_faces(surface.curves, region)) for region in regions]
    below = None if stand is None else part_of("stand", stand_solid(stand, tolerance=wish.tolerance))
    drilling = Drilling(made.parts, joints, places, below)
    return placed_openings(drilling, diameter=wish.opening_diameter, count=wish.opening_count, rim=wish.wall)
