"""Fit coupons: five clearances, two pieces of each, all flat on the plate, and gaps and necks as on the sculpture."""

from __future__ import annotations

import numpy as np
import pytest
from coupons import CLEARANCE, WALL, Name, subject, tried
from manifold3d import CrossSection, Manifold
from shapely import LineString, Polygon

from fabricate.errors import SolidError
from fabricate.solid.booleans import manifold_of
from fabricate.solid.coupon import (
    BAR,
    DIGITS,
    RAISED,
    STROKE,
    Coupon,
    CouponPiece,
    coupon,
    coupon_clearances,
    label,
)
from fabricate.solid.coupon_places import Kind
from fabricate.solid.lettering import raised_text, text_width
from fabricate.solid.part import Part
from fabricate.solid.sound_turn import TURNS
from fabricate.surface.neck import tile_necks
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.normals import area_vectors, unit


@pytest.fixture(scope="module", params=["ring", "core", pytest.param("bands", marks=pytest.mark.slow)])
def made(request: pytest.FixtureRequest) -> Coupon:
    return tried(request.param)


@pytest.mark.parametrize(
    ("clearance", "wanted"),
    [
        (0.3, (0.2, 0.25, 0.3, 0.35, 0.4)),
        (0.5, (0.3, 0.4, 0.5, 0.6, 0.7)),
        (0.25, (0.15, 0.2, 0.25, 0.3, 0.35)),
        (0.1, (0.06, 0.08, 0.1, 0.12, 0.14)),
        (0.03, (0.01, 0.02, 0.03, 0.04, 0.05)),
        (0.32, (0.22, 0.27, 0.32, 0.37, 0.42)),
    ],
)
def test_clearances_are_even_steps_about_that_of_the_sculpture(clearance: float, wanted: tuple[float, ...]) -> None:
    assert coupon_clearances(clearance) == pytest.approx(wanted, abs=1e-9)


@pytest.mark.parametrize(("clearance", "reason"), [(0.0, "0 mm"), (0.02, "more than 0.02 mm")])
def test_without_a_gap_to_try_there_is_none(clearance: float, reason: str) -> None:
    with pytest.raises(SolidError, match=reason):
        coupon_clearances(clearance)


@pytest.mark.parametrize(("clearance", "text"), [(0.3, "0.30"), (0.25, "0.25"), (0.125, "0.125"), (1.0, "1.00")])
def test_labels_say_all_of_a_clearance(clearance: float, text: str) -> None:
    assert label(clearance) == text


def test_there_are_five_pairs_of_pieces_in_windows_of_their_own(made: Coupon) -> None:
    pieces = made.pieces
    assert [piece.clearance for piece in pieces] == np.repeat(coupon_clearances(CLEARANCE), 2).tolist()
    assert [piece.window.place.kind for piece in pieces] == ["neck", "bend"] * 5
    for piece in pieces:
        away = np.hypot(*(piece.part.points[:, :2] - piece.middle).T)
        assert away.max() < piece.window.radius - 0.7


def test_every_solid_is_whole_lies_flat_and_does_not_cross_itself(made: Coupon) -> None:
    for part in (made.plate, *(piece.part for piece in made.pieces)):
        assert len(manifold_of(part).decompose()) == 1
        assert part.points[:, 2].min() == 0.0
        assert not len(crossing_triangles(part.points, part.triangles))


def test_nothing_overhangs_by_more_than_45_degrees(made: Coupon) -> None:
    for part in (made.plate, *(piece.part for piece in made.pieces)):
        vectors = area_vectors(part.points, part.triangles)
        above = part.points[part.triangles][:, :, 2].max(axis=1) > 0.0
        sizeable = np.linalg.norm(vectors, axis=1) > 1e-3
        assert unit(vectors[above & sizeable])[:, 2].min() > -0.75


def test_the_gap_around_each_piece_is_what_stands_under_it(made: Coupon) -> None:
    plate = manifold_of(made.plate)
    for piece in made.pieces:
        gap = manifold_of(piece.part).min_gap(plate, 2.0 * piece.clearance)
        assert 0.95 * piece.clearance <= gap <= 1.15 * piece.clearance


def of_the_sculpture(name: Name, piece: CouponPiece) -> list[Manifold]:
    """Return the sculpture's solids by region, where the window of a piece has put them."""
    middle = np.append(piece.middle, 0.0)
    return [
        manifold_of(Part(part.name, piece.window.seen(part.points) + middle, part.triangles))
        for part in subject(name).solids(piece.clearance).parts
    ]


def differing(one: Manifold, other: Manifold) -> float:
    """Return the volume that two solids do not share, mm3."""
    return float((one - other).volume() + (other - one).volume())


@pytest.mark.parametrize("kind", ["neck", "bend"])
@pytest.mark.parametrize("name", ["ring", "core"])
def test_around_the_place_the_joint_is_that_of_the_sculpture(name: Name, kind: Kind) -> None:
    made = tried(name)
    (piece,) = (each for each in made.pieces if each.clearance == CLEARANCE and each.window.place.kind == kind)
    region = piece.window.place.region
    solids = of_the_sculpture(name, piece)
    insert, plate = manifold_of(piece.part), manifold_of(made.plate)
    radius = 0.5 * piece.window.place.size if kind == "neck" else 0.5
    probe = Manifold.cylinder(5.0, radius + CLEARANCE).translate([*piece.middle, 0.0])
    assert differing(insert ^ probe, solids[region] ^ probe) == pytest.approx(0.0, abs=1e-2)
    assert differing(plate ^ probe, solids[1 - region] ^ probe) == pytest.approx(0.0, abs=1e-2)
    assert (insert - solids[region]).volume() == pytest.approx(0.0, abs=1e-2)


@pytest.mark.parametrize("name", ["ring", "core"])
def test_the_neck_is_the_narrowest_of_the_sculpture(name: Name) -> None:
    made = tried(name)
    narrowest = tile_necks(subject(name).surface)[0].min()
    for piece in made.pieces[::2]:
        assert piece.window.place.size == narrowest == made.wanted["neck"]
        x, y = piece.middle
        section = Polygon(max(manifold_of(piece.part).slice(0.8 * piece.window.depth).to_polygons(), key=len))
        turns = np.radians(np.arange(0.0, 180.0, 5.0))
        ways = 5.0 * np.column_stack([np.cos(turns), np.sin(turns)])
        chords = [LineString([(x - dx, y - dy), (x + dx, y + dy)]).intersection(section).length for dx, dy in ways]
        assert min(chords) == pytest.approx(narrowest - piece.clearance, rel=0.1)


def test_labels_stand_raised_under_their_columns(made: Coupon) -> None:
    plate = manifold_of(made.plate)
    letters = plate.slice(made.thickness + 0.5 * RAISED) ^ CrossSection.square([200.0, BAR + DIGITS + 0.1])
    size = {"height": DIGITS, "stroke": STROKE}
    wanted = [raised_text(text, **size, thickness=1.0).volume() for text in made.labels]
    assert letters.area() == pytest.approx(sum(wanted), rel=1e-4)
    assert made.labels == ("0.20", "0.25", "0.30", "0.35", "0.40")
    for text, piece in zip(made.labels, made.pieces[::2], strict=True):
        half = 0.5 * text_width(text, **size)
        column = letters ^ CrossSection.square([2.0 * half, 20.0]).translate([piece.middle[0] - half, 0.0])
        assert column.area() == pytest.approx(raised_text(text, **size, thickness=1.0).volume(), rel=1e-4)
    strip = made.plate.points[made.plate.points[:, 1] < BAR + DIGITS + 0.1]
    assert strip[:, 2].max() == pytest.approx(made.thickness + RAISED, abs=1e-6)


def test_the_same_sculpture_gives_the_same_bytes() -> None:
    ring, made = subject("ring"), tried("ring")
    again = coupon(ring.surface, ring.joined, ring.solids, clearance=CLEARANCE, core=ring.core, wall=WALL)
    assert again.plate.points.tobytes() == made.plate.points.tobytes()
    assert again.inserts.points.tobytes() == made.inserts.points.tobytes()


def test_where_no_wall_is_thick_enough_it_is_said() -> None:
    ring = subject("ring")
    with pytest.raises(SolidError, match="flat enough"):
        coupon(ring.surface, ring.joined, ring.solids, clearance=CLEARANCE, core=ring.core, wall=3.0)


def test_a_coupon_that_no_turn_leaves_sound_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    tried_turns = []

    def unsound(_: Part) -> bool:
        tried_turns.append(1)
        return False

    monkeypatch.setattr("fabricate.solid.coupon.is_sound", unsound)
    of = subject("ring")
    with pytest.raises(SolidError, match=r"ask for another solid.clearance"):
        coupon(of.surface, of.joined, of.solids, clearance=CLEARANCE, core=of.core, wall=WALL)
    assert len(tried_turns) == len(TURNS)
