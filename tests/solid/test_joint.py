"""Joints: walls lean or have a ridge, by as much as asked, the gap stays as wide, and what does not fit is refused."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from fabricate.checks.joint_profile import joint_facts
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.errors import SolidError
from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus
from fabricate.solid.assembly import Assembly, Core, assembly
from fabricate.solid.booleans import manifold_of
from fabricate.solid.joint import STRAIGHT, Joint, fitted_joint, tapered
from fabricate.solid.part import Part
from fabricate.solid.settling import fitted_cut
from fabricate.solid.solids import solids
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled
from fabricate.triangles.crossing import crossing_triangles

THICKNESS = 2.4
PUSHED = 0.6
DRAFT = Joint(kind="draft", angle=6.0)
TONGUE = Joint(kind="tongue", height=0.35, width=1.2)
JOINTS = {"straight": STRAIGHT, "draft": DRAFT, "inward": Joint(kind="draft", angle=-5.0), "tongue": TONGUE}


def cut_surface(*, clearance: float, rings: tuple[float, ...] = (0.5,), tile: float = 13.0) -> CutSurface:
    quads = tiled(sized(torus(around=10, across=5, tube=0.45), size=80), tile_size=tile)
    return fitted_cut(grown_duotone(quads, tree="random", seed=7), rings=rings, tolerance=0.5, clearance=clearance)


@pytest.fixture(scope="module")
def made() -> Callable[..., Assembly]:
    """Return what makes each pair once."""
    known: dict[tuple[str, float, Core], Assembly] = {}
    surfaces = {clearance: cut_surface(clearance=clearance) for clearance in (0.0, 0.3)}

    def make(joint: str, clearance: float, core: Core = "hollow") -> Assembly:
        key = (joint, clearance, core)
        if key not in known:
            known[key] = solids(
                surfaces[clearance], thickness=THICKNESS, clearance=clearance, core=core, joint=JOINTS[joint]
            )
        return known[key]

    return make


@pytest.mark.parametrize(
    ("joint", "core"), [*((joint, "hollow") for joint in JOINTS), ("draft", "blue"), ("tongue", "blue")]
)
def test_the_gap_is_as_wide_as_the_clearance_everywhere(made: Callable[..., Assembly], joint: str, core: Core) -> None:
    found = made(joint, 0.3, core)
    yellow, blue = map(manifold_of, found.parts)
    assert (yellow ^ blue).volume() == 0.0
    assert yellow.min_gap(blue, 0.6) >= 0.95 * 0.3
    assert [len(crossing_triangles(part.points, part.triangles)) for part in found.parts] == [0, 0]
    gap, shell = map(manifold_of, found.spaces)
    assert yellow.volume() + blue.volume() + gap.volume() == pytest.approx(shell.volume(), rel=1e-3)


@pytest.mark.parametrize(
    ("joint", "core"), [("draft", "hollow"), ("tongue", "hollow"), ("inward", "blue"), ("tongue", "blue")]
)
def test_without_clearance_facing_triangles_are_the_same(made: Callable[..., Assembly], joint: str, core: Core) -> None:
    found = made(joint, 0.0, core)
    yellow, blue = ({tuple(sorted(each)) for each in body.tolist()} for body in found.bodies)
    rings = 6 if joint == "tongue" else 1
    walls = 2 * rings * len(cut_surface(clearance=0.0).curves[0])
    assert len(yellow & blue) == walls + (0 if core == "hollow" else len(yellow) - walls - outside(found))
    first, second = map(manifold_of, found.parts)
    assert (first ^ second).volume() <= 1e-6 * first.volume()
    assert first.volume() + second.volume() == pytest.approx(manifold_of(found.spaces[1]).volume(), rel=1e-9)
    both = np.concatenate(found.bodies)
    once = both[np.unique(np.sort(both, axis=1), axis=0, return_index=True)[1]]
    assert len(crossing_triangles(found.points, once)) == 0


def outside(found: Assembly) -> int:
    """Return how many of yellow's triangles are on the outer surface."""
    return int((found.bodies[0] < found.surface_points).all(axis=1).sum())


def depths_and_moves(found: Assembly, surface: CutSurface) -> tuple[np.ndarray, np.ndarray]:
    """Return, for parts that touch, how deep and how far aside, to the right, each point of the wall is."""
    curve = surface.curves[0]
    at, normals = surface.points[curve], surface.normals[curve]
    conormal = np.cross(np.roll(at, -1, axis=0) - np.roll(at, 1, axis=0), normals)
    conormal /= np.linalg.norm(conormal, axis=1, keepdims=True)
    blocks = found.points.reshape(-1, found.surface_points, 3)[:, curve]
    away = blocks - at
    return -np.einsum("bcj,cj->bc", away, normals), np.einsum("bcj,cj->bc", away, conormal)


@pytest.mark.parametrize("joint", ["draft", "inward"])
def test_a_draft_leans_by_its_angle(made: Callable[..., Assembly], joint: str) -> None:
    surface = cut_surface(clearance=0.0)
    straight, leaning = (depths_and_moves(made(each, 0.0), surface) for each in ("straight", joint))
    move = leaning[1][1] - straight[1][1]
    angle = np.degrees(np.arctan2(move, leaning[0][1]))
    assert np.median(angle) == pytest.approx(JOINTS[joint].angle, rel=0.1)


def test_a_tongue_has_its_height_at_mid_thickness_and_its_width(made: Callable[..., Assembly]) -> None:
    surface = cut_surface(clearance=0.0)
    straight, ridge = (depths_and_moves(made(each, 0.0), surface) for each in ("straight", "tongue"))
    depth, move = ridge[0][2:7], ridge[1][2:7]
    across = depth / straight[0][1]
    without = straight[1][1] * across
    height = move - without
    assert np.median(height[2]) == pytest.approx(TONGUE.height, rel=0.1)
    assert np.abs(np.median(height[[0, 4]], axis=1)).max() < 0.02
    assert np.median(depth[2]) == pytest.approx(THICKNESS / 2, rel=0.05)
    assert np.median(depth[4] - depth[0]) == pytest.approx(TONGUE.width, rel=0.05)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_tongue_stops_what_is_pushed_out_or_in(way: float) -> None:
    """On a sphere all of yellow moves along the normal when it grows, and straight walls are cones: nothing is met."""
    quads = tiled(sized(sphere(faces="triangles", frequency=2), size=60), tile_size=10)
    surface = fitted_cut(grown_duotone(quads, tree="random", seed=1), rings=(0.5,), tolerance=0.3, clearance=0.2)
    common = []
    for joint in (STRAIGHT, Joint(kind="tongue")):
        yellow, blue = solids(surface, thickness=THICKNESS, clearance=0.2, joint=joint).parts
        grown = Part(yellow.name, yellow.points * (1.0 + way * PUSHED / 30.0), yellow.triangles)
        common.append((manifold_of(grown) ^ manifold_of(blue)).volume())
    assert common[0] == 0.0
    assert common[1] > 0.01 * PUSHED * float(
        np.linalg.norm(np.diff(surface.points[surface.curves[0]], axis=0), axis=1).sum()
    )


def test_sizes_that_are_not_given_are_those_that_fit() -> None:
    surface = cut_surface(clearance=0.3)
    inner = surface.points - THICKNESS * surface.normals
    found = fitted_joint(surface, inner, Joint(kind="tongue"), thickness=THICKNESS, clearance=0.3)
    assert found.height == pytest.approx(0.45)
    assert found.width is not None
    assert 0.6 * THICKNESS <= found.width <= 0.8 * THICKNESS
    assert fitted_joint(surface, inner, DRAFT, thickness=THICKNESS, clearance=0.3) == DRAFT


def test_where_no_tongue_fits_that_is_said() -> None:
    surface = cut_surface(clearance=0.3)
    with pytest.raises(SolidError, match=r"no tongue fits beside the curve: there is room for 0 mm"):
        solids(surface, thickness=THICKNESS, clearance=0.3, joint=Joint(kind="tongue", neck=9.0))


def test_a_tongue_that_would_pass_through_the_gap_is_refused_with_the_clearance_that_it_fits() -> None:
    surface = cut_surface(clearance=0.5)
    thin = 1.1
    with pytest.raises(SolidError, match="no tongue fits") as caught:
        solids(surface, thickness=thin, clearance=0.5, joint=Joint(kind="tongue"))
    largest = float(str(caught.value).split("solid.clearance with which one fits is ")[1].split(" mm")[0])
    assert 0.1 < largest < 0.5
    found = solids(surface, thickness=thin, clearance=largest, joint=Joint(kind="tongue"))
    ridge = joint_facts(surface, found, "tongue").ridge_mm
    assert ridge is not None
    assert ridge.median > largest
    with pytest.raises(SolidError, match="no tongue fits"):
        solids(surface, thickness=thin, clearance=largest + 0.011, joint=Joint(kind="tongue"))


def test_where_walls_are_mostly_thick_the_ridge_is_one_for_these() -> None:
    surface = cut_surface(clearance=0.3)
    depth = np.where(surface.points[:, 0] > np.quantile(surface.points[:, 0], 0.8), 1.0, THICKNESS)
    inner = surface.points - depth[:, None] * surface.normals
    found = fitted_joint(surface, inner, Joint(kind="tongue"), thickness=1.0, clearance=0.3)
    assert found.height == pytest.approx(0.45)


def test_limits_taper_off_by_the_millimetre() -> None:
    """A limit of 0 at one place lets others rise with their way to it, the shorter one round the curve."""
    angles = 2.0 * np.pi * np.arange(200) ** 2 / 200**2
    circle = 10.0 * np.stack([np.cos(angles), np.sin(angles), np.zeros(200)], axis=1)
    limits = np.where(np.arange(200) == 50, 0.0, 2.0)
    way = 10.0 * np.abs(np.remainder(angles - angles[50] + np.pi, 2.0 * np.pi) - np.pi)
    assert tapered(limits, circle, taper=0.1) == pytest.approx(np.minimum(0.1 * way, 2.0), abs=1e-3)
    assert tapered(np.full(200, -1.0), circle).tolist() == [0.0] * 200
    assert tapered(np.full(200, 2.0), circle).tolist() == pytest.approx([2.0] * 200)


def test_a_wide_neck_asks_for_a_lower_ridge() -> None:
    surface = cut_surface(clearance=0.3)
    inner = surface.points - THICKNESS * surface.normals
    sizes = [
        fitted_joint(surface, inner, Joint(kind="tongue", neck=neck), thickness=THICKNESS, clearance=0.3).height
        for neck in (0.0, 2.6)
    ]
    assert sizes[0] is not None
    assert sizes[1] is not None
    assert sizes[1] < sizes[0]


def test_each_curve_of_bands_has_the_joint() -> None:
    surface = cut_surface(clearance=0.1, rings=(0.37, 0.63), tile=16.0)
    found = solids(surface, thickness=THICKNESS, clearance=0.1, joint=Joint(kind="tongue", height=0.15, width=1.2))
    whole = list(map(manifold_of, found.parts))
    for one, other in ((0, 1), (1, 2), (0, 2)):
        assert (whole[one] ^ whole[other]).volume() == 0.0
        assert whole[one].min_gap(whole[other], 0.2) >= 0.95 * 0.1


@pytest.mark.parametrize(
    ("joint", "words", "unit", "fitting"),
    [
        (
            Joint(kind="tongue", height=5.0, width=1.2),
            "solid.tongue.height that fits is ",
            " mm",
            lambda size: Joint(kind="tongue", height=size, width=1.2),
        ),
        (
            Joint(kind="tongue", height=0.2, width=2.2),
            "solid.tongue.width that fits is ",
            " mm",
            lambda size: Joint(kind="tongue", height=0.2, width=size),
        ),
        (
            Joint(kind="draft", angle=-44.0),
            'solid.draft that fits is "',
            " deg",
            lambda size: Joint(kind="draft", angle=size),
        ),
        (
            Joint(kind="draft", angle=44.0),
            'solid.draft that fits is "',
            " deg",
            lambda size: Joint(kind="draft", angle=size),
        ),
    ],
)
def test_a_joint_that_does_not_fit_is_refused_with_the_size_that_does(
    joint: Joint, words: str, unit: str, fitting: Callable[[float], Joint]
) -> None:
    surface = cut_surface(clearance=0.3)
    with pytest.raises(SolidError, match=words) as caught:
        solids(surface, thickness=THICKNESS, clearance=0.3, joint=joint)
    assert "\n" not in str(caught.value)
    largest = float(str(caught.value).split(words)[1].split(unit)[0])
    found = solids(surface, thickness=THICKNESS, clearance=0.3, joint=fitting(largest))
    yellow, blue = map(manifold_of, found.parts)
    assert (yellow ^ blue).volume() == 0.0
    assert yellow.min_gap(blue, 0.6) >= 0.95 * 0.3


def test_where_the_wall_is_thin_the_ridge_is_smaller_in_proportion() -> None:
    quads = tiled(sized(sphere(faces="triangles", frequency=2), size=60), tile_size=10)
    surface = fitted_cut(grown_duotone(quads, tree="random", seed=1), rings=(0.5,), tolerance=0.3, clearance=0.0)
    half = 0.5 * TONGUE.width / 0.8
    inner = surface.points - half * surface.normals
    ridge = depths_and_moves(assembly(surface, inner, clearance=0.0, core="hollow", joint=TONGUE), surface)
    straight = depths_and_moves(assembly(surface, inner, clearance=0.0, core="hollow"), surface)
    top = ridge[1][4] - 0.5 * straight[1][1]
    assert np.median(top) == pytest.approx(TONGUE.height / 2, rel=0.1)
