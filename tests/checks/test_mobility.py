"""Mobility: joints whose freedom is known, from parting planes to balls that turn in their shells."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from manifold3d import Manifold
from scipy.spatial.transform import Rotation

from fabricate.arrays import Floats
from fabricate.checks.facts import Play
from fabricate.checks.gap import Spacing
from fabricate.checks.mobility import Mobility, contacts, joint_pivot, mobility, mobility_check
from fabricate.solid.part import Part
from fabricate.triangles.search_tree import SearchTree

GAP = 0.3


def part_of(manifold: Manifold) -> Part:
    mesh = manifold.to_mesh64()
    return Part("red", np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64))


def spacing(first: Part, second: Part) -> Spacing:
    return Spacing.between(SearchTree.of(first.points, first.triangles), SearchTree.of(second.points, second.triangles))


def judged(first: Part, second: Part) -> Mobility:
    return mobility(spacing(first, second), clearance=GAP)


def play_of(first: Part, second: Part) -> Play:
    found = judged(first, second)
    assert found.play is not None
    return found.play


def turned(part: Part, angle: float, axis: tuple[float, float, float]) -> Part:
    matrix = Rotation.from_rotvec(angle * np.array(axis) / np.linalg.norm(axis)).as_matrix()
    return Part(part.name, part.points @ matrix.T, part.triangles)


def ball(radius: float, shift: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Part:
    mesh = trimesh.creation.icosphere(subdivisions=3, radius=radius)
    return Part("red", mesh.vertices + np.array(shift), mesh.faces)


def case(radius: float, *, shift: tuple[float, float, float] = (0.0, 0.0, 0.0), side: float = 40.0) -> Part:
    """Return a cube with a spherical hollow, its facets parallel to those of `ball`."""
    hollow = ball(radius, shift)
    cube = trimesh.creation.box(3 * [side])
    return Part(
        "blue",
        np.concatenate([cube.vertices, hollow.points]),
        np.concatenate([cube.faces, hollow.triangles[:, ::-1] + len(cube.vertices)]),
    )


def half_balls() -> tuple[Part, Part]:
    whole = Manifold.sphere(20, 64)
    return (
        part_of(whole.trim_by_plane((0, 0, 1), GAP / 2)),
        part_of(whole.trim_by_plane((0, 0, -1), GAP / 2)),
    )


def plate_with_hole(hole: Manifold) -> Part:
    return part_of(Manifold.cube((30, 30, 8), True) - hole)


def test_halves_of_a_ball_come_apart() -> None:
    first, second = half_balls()
    found = judged(first, second)
    assert found.verdict == "separable"
    assert found.play is not None
    assert found.play.z == np.inf  # up without end, whatever stops it below
    assert judged(second, first).verdict == "separable"


@settings(max_examples=10, deadline=None)
@given(st.floats(0.0, 3.0), st.tuples(*3 * [st.floats(0.1, 1.0)]))
def test_halves_come_apart_however_they_lie(angle: float, axis: tuple[float, float, float]) -> None:
    first, second = half_balls()
    assert judged(turned(first, angle, axis), turned(second, angle, axis)).verdict == "separable"


def test_a_round_peg_slides_and_turns_in_its_hole() -> None:
    peg = part_of(Manifold.cylinder(20, 5, 5, 64, True))
    plate = plate_with_hole(Manifold.cylinder(40, 5 + GAP, 5 + GAP, 64, True))
    found = judged(peg, plate)
    assert found.verdict == "separable"
    assert found.play is not None
    assert found.play.z == np.inf
    assert found.play.x == pytest.approx(2 * GAP, rel=0.02)
    assert found.play.y == pytest.approx(2 * GAP, rel=0.02)
    assert np.isfinite([found.play.rx, found.play.ry]).all()


def test_a_square_peg_slides_along_one_axis_only() -> None:
    peg = part_of(Manifold.cube((10, 10, 20), True))
    plate = plate_with_hole(Manifold.cube((10 + 2 * GAP, 10 + 2 * GAP, 40), True))
    play = play_of(peg, plate)
    assert [play.x, play.y] == pytest.approx([2 * GAP, 2 * GAP], rel=1e-4)
    assert play.z == np.inf
    assert np.isfinite([play.rx, play.ry, play.rz]).all()


def test_a_slanted_peg_slides_too() -> None:
    peg = turned(part_of(Manifold.cube((10, 10, 20), True)), 0.7, (1, 2, 3))
    plate = turned(plate_with_hole(Manifold.cube((10 + 2 * GAP, 10 + 2 * GAP, 40), True)), 0.7, (1, 2, 3))
    assert judged(peg, plate).verdict == "separable"


def test_a_peg_with_heads_is_captive() -> None:
    peg = part_of(
        Manifold.cylinder(8 + 2 * GAP, 5, 5, 64, True)
        + Manifold.cylinder(3, 9, 9, 64).translate((0, 0, 4 + GAP))
        + Manifold.cylinder(3, 9, 9, 64).translate((0, 0, -7 - GAP))
    )
    plate = plate_with_hole(Manifold.cylinder(40, 5 + GAP, 5 + GAP, 64, True))
    found = judged(peg, plate)
    assert found.verdict == "captive"
    assert found.play is not None
    assert found.play.z == pytest.approx(2 * GAP, rel=1e-3)
    assert found.play.x == pytest.approx(2 * GAP, rel=0.02)


def test_a_box_in_a_box_is_captive_with_the_gap_on_either_side() -> None:
    inner = part_of(Manifold.cube((10, 12, 14), True))
    outer = part_of(Manifold.cube((20, 20, 20), True) - Manifold.cube((10 + 2 * GAP, 12 + 2 * GAP, 14 + 2 * GAP), True))
    found = judged(inner, outer)
    assert found.verdict == "captive"
    assert found.play is not None
    assert [found.play.x, found.play.y, found.play.z] == pytest.approx(3 * [2 * GAP], rel=1e-4)
    assert judged(outer, inner).verdict == "captive"


@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), (8.0, -3.0, 5.0)])
def test_a_ball_in_a_shell_turns_freely_and_is_captive(shift: tuple[float, float, float]) -> None:
    inside, outside = ball(10.0, shift), case(10.0 + GAP, shift=shift)
    for first, second in ((inside, outside), (outside, inside)):
        found = judged(first, second)
        assert found.verdict == "captive"
        assert found.play is not None
        assert [found.play.x, found.play.y, found.play.z] == pytest.approx(3 * [2 * GAP], rel=0.03)
        assert min(found.play.rx, found.play.ry, found.play.rz) > 5.0  # until facets catch in each other


def test_a_curved_peg_turns_out_of_its_hole() -> None:
    def arc(tube: float, degrees: float) -> Manifold:
        circle = Manifold.cylinder(1, tube, tube, 32).slice(0.5)
        return circle.translate((20, 0)).revolve(128, degrees)

    peg = part_of(arc(3, 60).rotate((0, 0, -10)))
    block = part_of(Manifold.cube((16, 24, 12)).translate((10, 2, -6)) - arc(3 + GAP, 90).rotate((0, 0, -20)))
    assert judged(peg, block).verdict == "separable"


def test_parts_far_from_each_other_are_separable() -> None:
    assert judged(ball(5.0), ball(5.0, (30.0, 0.0, 0.0))).verdict == "separable"


def test_contacts_face_each_other_at_the_clearance() -> None:
    met = contacts(spacing(ball(10.0), case(10.0 + GAP)), clearance=GAP)
    assert len(met.gaps) > 1000
    assert met.gaps == pytest.approx(GAP, rel=0.01)
    outward = np.einsum("ij,ij->i", met.points, met.normals)
    assert (outward > 0.95 * np.linalg.norm(met.points, axis=1)).all()


def test_the_pivot_of_a_ball_is_its_centre() -> None:
    centre = np.array([8.0, -3.0, 5.0])
    inside, outside = ball(10.0, (8.0, -3.0, 5.0)), case(10.0 + GAP, shift=(8.0, -3.0, 5.0))
    met = contacts(spacing(outside, inside), clearance=GAP)
    assert np.linalg.norm(joint_pivot(met, np.zeros(3)) - centre) < 1e-3


def test_the_pivot_of_planes_stays_as_high_as_the_centroid() -> None:
    met = contacts(spacing(*half_balls()), clearance=GAP)
    centroid: Floats = np.array([1.0, 2.0, 9.0])
    assert joint_pivot(met, centroid) == pytest.approx([*met.points[:, :2].mean(axis=0), 9.0])


def test_without_contacts_the_pivot_is_the_centroid() -> None:
    met = contacts(spacing(ball(5.0), ball(5.0, (30.0, 0.0, 0.0))), clearance=GAP)
    assert len(met.gaps) == 0
    assert joint_pivot(met, np.ones(3)).tolist() == [1, 1, 1]


def test_verdicts_are_compared_with_what_is_expected() -> None:
    red, blue = ball(1.0), ball(2.0)
    loose = Mobility("separable", Play(*6 * [np.inf]))
    caught = Mobility("captive", Play(*6 * [0.6]))
    assert mobility_check("fit.mobility", red, blue, caught, expected="captive").ok
    assert mobility_check("fit.mobility", red, blue, loose, expected="separable").ok
    assert mobility_check("fit.mobility", red, blue, Mobility("fused", None), expected="fused").ok
    failed = mobility_check("fit.mobility", red, blue, loose, expected="captive")
    assert failed.failed
    assert "come apart" in failed.message
