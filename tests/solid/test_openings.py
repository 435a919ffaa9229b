"""Openings: as many handles as holes, their volume gone, no neck cut, and a clear error where there is no room."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from bar_at_corner import UP, bar_at_corner
from crafted import Crafted, crafted
from manifold3d import Manifold

from fabricate.checks.walls import walls
from fabricate.errors import SolidError
from fabricate.mesh.torus import torus
from fabricate.solid.booleans import manifold_of, part_of
from fabricate.solid.openings import Drilling, Opening, drilled, drills, placed_openings
from fabricate.solid.part import Part
from fabricate.solid.room import Places, roomy_places
from fabricate.solid.sound_turn import is_sound
from fabricate.solid.stand import placed_stand, stand_solid
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.normals import area_vectors
from fabricate.triangles.search_tree import SearchTree

DIAMETER, CLEARANCE, RIM, THICKNESS = 3.5, 0.3, 0.8, 2.0


@pytest.fixture(scope="module")
def ring() -> Crafted:
    return crafted(torus(around=8, across=4, tube=0.45), size=80, tile=12, clearance=CLEARANCE)


def joint(ring: Crafted, region: int) -> SearchTree:
    return SearchTree.of(ring.made.points, ring.made.joint_faces(ring.surface.curves, region))


def drilling(ring: Crafted, *, stand: Part | None = None) -> Drilling:
    joints = [joint(ring, region) for region in range(2)]
    return Drilling(ring.made.parts, joints, roomy_places(ring.surface), stand)


def placed(ring: Crafted, *, count: int = 3, diameter: float = DIAMETER) -> tuple[Opening, ...]:
    return placed_openings(drilling(ring), diameter=diameter, count=count, rim=RIM)


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
    """From the axis of an opening to the part's own joint it is as far as a half diameter and the rim."""
    for opening in placed(ring):
        tree = joint(ring, [part.name for part in ring.made.parts].index(opening.part))
        depth = np.linspace(0.0, opening.wall, 9)[:, None]
        assert tree.nearest(opening.at + depth * opening.way).distance.min() >= DIAMETER / 2 + RIM


def test_the_first_is_low_and_the_others_are_far_from_it(ring: Crafted) -> None:
    first, second = (opening.at for opening in placed(ring, count=2))
    assert first[2] < 0
    assert np.linalg.norm(second - first) > 40


@pytest.mark.parametrize("count", [1, 3, 12])
def test_what_does_not_fit_is_refused_with_the_size_that_would(ring: Crafted, count: int) -> None:
    with pytest.raises(SolidError, match="found no room; the largest that fits is") as caught:
        placed(ring, diameter=20.0, count=count)
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith("1 opening of 20 mm was asked" if count == 1 else f"{count} openings of 20 mm")
    fits = float(str(caught.value).split("the largest that fits is ")[1].split(" mm")[0])
    openings = placed(ring, diameter=fits, count=count)
    assert len(openings) == count
    assert min(thinnest(drilled(part, openings, tolerance=0.05).part) for part in ring.made.parts) >= RIM


def thinnest(part: Part) -> float:
    tree, vectors = SearchTree.of(part.points, part.triangles), area_vectors(part.points, part.triangles)
    spread = walls(part, tree, vectors).spread
    assert spread is not None
    return spread.min


def test_a_hint_is_never_larger_than_what_was_measured(ring: Crafted) -> None:
    """Between the largest places that there are, one more asked for makes the hint smaller or leaves it."""
    hints = []
    for count in (1, 4, 8):
        with pytest.raises(SolidError, match="the largest that fits is") as caught:
            placed(ring, diameter=20.0, count=count)
        hints.append(float(str(caught.value).split("the largest that fits is ")[1].split(" mm")[0]))
    assert hints == sorted(hints, reverse=True)


def test_openings_leave_a_rim_between_them() -> None:
    """Three places on a slab, two of them 3 mm from each other; the slab's side is the joint."""
    slab = part_of("yellow", Manifold.cube((60.0, 60.0, THICKNESS)))
    points = np.array([[20.0, 30.0, THICKNESS], [23.0, 30.0, THICKNESS], [40.0, 30.0, THICKNESS]])
    places = Places(points, np.tile(UP, (3, 1)), np.full(3, 20.0), np.zeros(3, dtype=np.int64))
    aside = (slab.points[slab.triangles][:, :, 0] == 0.0).all(axis=1)
    task = Drilling((slab,), (SearchTree.of(slab.points, slab.triangles[aside]),), places)
    assert len(placed_openings(task, diameter=2.5, count=2, rim=RIM)) == 2
    with pytest.raises(SolidError, match="found room for 2; the largest that fits is") as caught:
        placed_openings(task, diameter=2.5, count=3, rim=RIM)
    fits = float(str(caught.value).split("the largest that fits is ")[1].split(" mm")[0])
    assert 1.9 < fits <= 3.0 - RIM
    bars = [drills([each], tolerance=0.05) for each in placed_openings(task, diameter=fits, count=3, rim=RIM)]
    assert min(one.min_gap(other, 10.0) for one, other in combinations(bars, 2)) >= RIM


def test_the_way_out_is_free_of_the_stand(ring: Crafted) -> None:
    """Without a stand the lowest opening looks down, where its plate is; with it, openings are where none is near."""
    plan = placed_stand(
        ring.made.parts, roomy_places(ring.surface), height=3.0, clearance=CLEARANCE, wall=RIM, tolerance=0.05
    )
    stand = part_of("stand", stand_solid(plan, tolerance=0.05))
    tree = SearchTree.of(stand.points, stand.triangles)
    out = np.linspace(0.0, DIAMETER, 20)[:, None]

    def beside(opening: Opening) -> float:
        return float(tree.nearest(opening.at - out * opening.way).distance.min())

    hindered = placed(ring, count=3)
    free = placed_openings(drilling(ring, stand=stand), diameter=DIAMETER, count=3, rim=RIM)
    assert beside(hindered[0]) < DIAMETER / 2
    assert min(map(beside, free)) >= 0.97 * DIAMETER / 2


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
