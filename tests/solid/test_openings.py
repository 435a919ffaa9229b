"""Openings: as many handles as holes, their volume gone, no neck cut, and a clear error where there is no room."""

from __future__ import annotations

import numpy as np
import pytest
from bar_at_corner import UP, bar_at_corner
from crafted import Crafted, crafted

from fabricate.errors import SolidError
from fabricate.mesh.torus import torus
from fabricate.solid.booleans import manifold_of, part_of
from fabricate.solid.openings import Opening, drilled, drills, placed_openings
from fabricate.solid.room import roomy_places
from fabricate.solid.sound_turn import is_sound
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.search_tree import SearchTree

DIAMETER, CLEARANCE, RIM, THICKNESS = 3.5, 0.3, 0.8, 2.0


@pytest.fixture(scope="module")
def ring() -> Crafted:
    return crafted(torus(around=8, across=4, tube=0.45), size=80, tile=12, clearance=CLEARANCE)


def placed(ring: Crafted, *, count: int = 3, diameter: float = DIAMETER) -> tuple[Opening, ...]:
    places = roomy_places(ring.surface)
    return placed_openings(ring.made.parts, places, diameter=diameter, count=count, clearance=CLEARANCE, rim=RIM)


def test_each_opening_is_a_handle_and_takes_its_own_volume(ring: Crafted) -> None:
    openings = placed(ring)
    assert len(openings) == 3
    for part in ring.made.parts:
        count = sum(opening.part == part.name for opening in openings)
        before, holed = manifold_of(part), drilled(part, openings, tolerance=0.05).part
        after = manifold_of(holed)
        assert after.genus() == before.genus() + count
        taken = count * np.pi * (DIAMETER / 2) ** 2 * THICKNESS
        assert before.volume() - after.volume() == pytest.approx(taken, rel=0.05)
        assert len(after.decompose()) == 1
        assert not len(crossing_triangles(holed.points, holed.triangles))


def test_what_is_not_at_an_opening_stays_to_the_last_bit(ring: Crafted) -> None:
    openings = placed(ring)
    for part in ring.made.parts:
        holed = drilled(part, openings, tolerance=0.05).part
        at = np.array([opening.at for opening in openings if opening.part == part.name]).reshape(-1, 1, 3)
        far = (np.linalg.norm(part.points - at, axis=2) > 2 * DIAMETER).all(axis=0)
        kept = {tuple(point) for point in holed.points.tolist()}
        assert far.any()
        assert all(tuple(point) in kept for point in part.points[far].tolist())


def test_no_neck_is_cut(ring: Crafted) -> None:
    """From the axis of an opening to any other part it is as far as a half diameter, the rim and the gap."""
    for opening in placed(ring):
        (other,) = (part for part in ring.made.parts if part.name != opening.part)
        depth = np.linspace(0.0, opening.wall, 9)[:, None]
        nearest = SearchTree.of(other.points, other.triangles).nearest(opening.at + depth * opening.way)
        assert nearest.distance.min() >= DIAMETER / 2 + RIM + CLEARANCE - 1e-6


def test_the_first_is_low_and_the_others_are_far_from_it(ring: Crafted) -> None:
    first, second = (opening.at for opening in placed(ring, count=2))
    assert first[2] < 0
    assert np.linalg.norm(second - first) > 40


def test_what_does_not_fit_is_refused_with_the_size_that_would(ring: Crafted) -> None:
    with pytest.raises(SolidError, match="found no room; the largest that fits is") as caught:
        placed(ring, diameter=20.0)
    assert "\n" not in str(caught.value)
    fits = float(str(caught.value).split("the largest that fits is ")[1].split(" mm")[0])
    assert len(placed(ring, diameter=0.99 * fits, count=3)) == 3


def test_a_part_without_openings_is_left_as_it_is(ring: Crafted) -> None:
    part = ring.made.parts[0]
    assert drilled(part, [], tolerance=0.05).part is part


def test_drills_are_turned_until_the_part_stays_sound_in_its_file() -> None:
    """The drill of an opening is as long as its wall and a radius more at either end."""
    part, bar = bar_at_corner(radius=2.0, tolerance=0.05)
    opening = Opening(part.name, bar.begin + 2.0 * UP, UP, 4.0, 5.0)
    straight = manifold_of(part) - drills([opening], tolerance=0.05)
    assert not is_sound(part_of("yellow", straight))
    found = drilled(part, [opening], tolerance=0.05)
    assert found.turn > 0.0
    assert is_sound(found.part)
    assert manifold_of(found.part).volume() == pytest.approx(straight.volume(), rel=1e-3)
