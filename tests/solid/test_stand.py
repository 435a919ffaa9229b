"""A stand: flat, under the centre of mass, one with its part, and away from the other."""

from __future__ import annotations

import numpy as np
import pytest
from bar_at_corner import UP, bar_at_corner
from crafted import Crafted, crafted

from fabricate.errors import SolidError
from fabricate.mesh.crease import creased
from fabricate.mesh.cube import cube
from fabricate.mesh.torus import torus
from fabricate.solid.assembly import Core
from fabricate.solid.booleans import bar, manifold_of, part_of
from fabricate.solid.room import roomy_places
from fabricate.solid.sound_turn import is_sound
from fabricate.solid.stand import Stand, placed_stand, stand_solid, standing
from fabricate.triangles.crossing import crossing_triangles

HEIGHT, WALL = 3.0, 0.8
BODIES = {
    "torus": (torus(around=8, across=4, tube=0.45), 60, 10, 0.3, "hollow"),
    "cube": (creased(cube(divisions=3), angle=40.0), 50, 8, 0.3, "hollow"),
    "core": (torus(around=8, across=4, tube=0.45), 60, 10, 0.3, "blue"),
    "no gap": (torus(around=8, across=4, tube=0.45), 60, 10, 0.0, "hollow"),
}


@pytest.fixture(scope="module", params=BODIES)
def body(request: pytest.FixtureRequest) -> tuple[Crafted, float]:
    mesh, size, tile, clearance, core = BODIES[request.param]
    assert core in ("hollow", "blue")
    keeper: Core = "blue" if core == "blue" else "hollow"
    return crafted(mesh, size=size, tile=tile, clearance=clearance, core=keeper), clearance


def planned(body: Crafted, clearance: float, *, height: float = HEIGHT) -> Stand:
    return placed_stand(
        body.made.parts,
        roomy_places(body.surface),
        height=height,
        clearance=clearance,
        wall=WALL,
        tolerance=0.05,
    )


def test_the_part_stands_flat_on_one_plate_and_stays_one_solid(body: tuple[Crafted, float]) -> None:
    crafted_body, clearance = body
    stand = planned(crafted_body, clearance)
    parts = [standing(part, stand, tolerance=0.05).part for part in crafted_body.made.parts]
    (own,) = (part for part in parts if part.name == stand.part)
    (before,) = (part for part in crafted_body.made.parts if part.name == stand.part)
    lowest = min(part.points[:, 2].min() for part in crafted_body.made.parts)
    assert own.points[:, 2].min() == pytest.approx(lowest - HEIGHT, abs=1e-5)
    after = manifold_of(own)
    assert after.genus() == manifold_of(before).genus() + len(stand.feet) - 1
    assert len(after.decompose()) == 1
    assert not len(crossing_triangles(own.points, own.triangles))
    assert stand.plate.end[2] - stand.plate.begin[2] >= WALL - 1e-9


def test_the_stand_keeps_the_gap_from_the_other_part(body: tuple[Crafted, float]) -> None:
    crafted_body, clearance = body
    stand = planned(crafted_body, clearance)
    own, other = (
        manifold_of(standing(part, stand, tolerance=0.05).part)
        for part in sorted(crafted_body.made.parts, key=lambda part: part.name != stand.part)
    )
    assert (own ^ other).volume() == pytest.approx(0.0, abs=1e-6)
    if clearance > 0.0:
        assert own.min_gap(other, 2 * clearance) >= 0.95 * clearance


def test_feet_go_up_into_their_own_part_alone(body: tuple[Crafted, float]) -> None:
    """No foot's top stands out beside the part: nothing of the stand is left over the face that it goes into."""
    crafted_body, clearance = body
    stand = planned(crafted_body, clearance)
    (own,) = (part for part in crafted_body.made.parts if part.name == stand.part)
    solid = manifold_of(own)
    for foot in stand.feet:
        top = foot._replace(begin=foot.end - 0.01 * UP, end=foot.end)
        disc = bar(top, tolerance=0.05)
        assert (disc - solid).volume() < 1e-6 * disc.volume()


def test_it_does_not_fall_over_when_tilted_by_ten_degrees(body: tuple[Crafted, float]) -> None:
    crafted_body, clearance = body
    stand = planned(crafted_body, clearance)
    shell = crafted_body.made.spaces[1]
    centre = shell.points.mean(axis=0)  # of a symmetric body
    rim = stand.plate.radius - np.linalg.norm(centre[:2] - stand.plate.begin[:2])
    assert np.degrees(np.arctan2(rim, centre[2] - stand.plate.begin[2])) > 10


def test_the_other_part_is_left_as_it_is(body: tuple[Crafted, float]) -> None:
    crafted_body, clearance = body
    stand = planned(crafted_body, clearance)
    (other,) = (part for part in crafted_body.made.parts if part.name != stand.part)
    assert standing(other, stand, tolerance=0.05).part is other


def test_a_stand_is_turned_until_the_part_stays_sound_in_its_file() -> None:
    part, foot = bar_at_corner(radius=2.0, tolerance=0.05)
    plate = foot._replace(end=foot.begin + 0.9 * UP, radius=5.0)
    stand = Stand(part.name, 1.0, plate, (foot,))
    straight = manifold_of(part) + stand_solid(stand, tolerance=0.05)
    assert not is_sound(part_of("yellow", straight))
    found = standing(part, stand, tolerance=0.05)
    assert found.turn > 0.0
    assert is_sound(found.part)
    assert manifold_of(found.part).volume() == pytest.approx(straight.volume(), rel=1e-3)


def test_a_stand_too_low_for_a_plate_is_refused_with_the_height_that_fits() -> None:
    ring = crafted(torus(around=8, across=4, tube=0.45), size=60, tile=10, clearance=0.5)
    with pytest.raises(SolidError, match=r"solid.base.height of at least 1\.31 mm"):
        planned(ring, 0.5, height=1.2)
    stand = planned(ring, 0.5, height=1.31)
    (own,) = (standing(part, stand, tolerance=0.05).part for part in ring.made.parts if part.name == stand.part)
    heights = np.unique(own.points[:, 2])
    top = heights[np.abs(heights - stand.plate.end[2]).argmin()]
    assert top - heights[0] >= WALL  # of the plate, as its file holds it


def test_a_part_without_room_for_a_foot_is_refused() -> None:
    small = crafted(torus(around=8, across=4, tube=0.45), size=20, tile=3, clearance=0.1, thickness=0.5)
    with pytest.raises(SolidError, match="no place near the bottom") as caught:
        planned(small, 0.1)
    assert "\n" not in str(caught.value)
