"""Known-bad pairs: each check is shown a fault made for it, and finds it within a tenth of a millimetre."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from manifold3d import CrossSection, Manifold

from fabricate.arrays import Floats
from fabricate.checks.check import Check
from fabricate.checks.expectations import Expectations
from fabricate.checks.judge import Judgement, judged_parts
from fabricate.process import PROCESSES
from fabricate.solid.part import Part

GAP, HEIGHT, NEAR = 0.3, 2.4, 0.1
SPOT = np.array([3.1, -2.3])
"""Where faults are made: y of all, and x of those that are not at the wall."""

Warp = Callable[[Floats], Floats]


def part_of(name: str, manifold: Manifold) -> Part:
    mesh = manifold.to_mesh64()
    return Part(name, np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64))


def slab(name: str, *, left: float, right: float, warp: Warp = lambda points: points, fine: float = 0.25) -> Part:
    """Return a slab of fine triangles from x = left to x = right, 12 mm wide, after a warp of its points."""
    box = Manifold.cube((right - left, 12, HEIGHT)).translate((left, -6, 0)).refine_to_length(fine)
    part = part_of(name, box)
    return Part(name, warp(part.points.copy()), part.triangles)


def hill(points: Floats, *, x: float | None = None) -> Floats:
    """Return a bump of height 1 over the spot, or along the height of a wall at it, for each point."""
    away = points[:, 1] - SPOT[1] if x is None else np.linalg.norm(points[:, :2] - [x, SPOT[1]], axis=1)
    bump: Floats = np.exp(-((away / 0.8) ** 2))
    return bump


def judged(first: Part, second: Part, *, middles: bool = False) -> Judgement:
    line = np.column_stack([np.zeros(401), np.linspace(-5, 5, 401), np.full(401, HEIGHT / 2)])
    known = {f"{first.name}-{second.name}": line} if middles else {}
    return judged_parts([first, second], Expectations(clearance=GAP, process=PROCESSES["fdm"], middles=known))


def check_of(found: Judgement, code: str) -> Check:
    (check,) = [check for check in found.checks if check.code == code]
    return check


LEFT, RIGHT = (-8.0, -GAP / 2), (GAP / 2, 8.0)


def good(name: str) -> Part:
    left, right = LEFT if name == "red" else RIGHT
    return slab(name, left=left, right=right)


def test_the_good_pair_passes() -> None:
    found = judged(good("red"), good("blue"), middles=True)
    assert {check.code for check in found.checks if check.failed} == {"fit.mobility"}  # two slabs come apart


def test_a_thin_spot() -> None:
    def dented(points: Floats) -> Floats:
        top = points[:, 2] > HEIGHT - 1e-3
        points[top, 2] -= 1.9 * hill(points[top], x=-SPOT[0])
        return points

    red = slab("red", left=LEFT[0], right=LEFT[1], warp=dented)
    near = np.linalg.norm(red.points[:, :2] - [-SPOT[0], SPOT[1]], axis=1) < 1.0
    truth = min(red.points[near & (red.points[:, 2] > 0.1)], key=lambda point: point[2])
    check = check_of(judged(red, good("blue")), "red.wall")
    assert check.failed
    assert np.linalg.norm(check.where[0, :2] - truth[:2]) < NEAR
    assert check_of(judged(red, good("blue")), "blue.wall").ok


def test_a_groove_that_no_ray_measures() -> None:
    # Its sides are so steep that they are no walls opposite the bottom: only a ball is stopped by its edge.
    groove = Manifold.extrude(cross_section(np.array([[0.0, 0.5], [1.2, 2.6], [-1.2, 2.6]])), 2.0)
    cut = groove.rotate((90, 0, 0)).rotate((0, 0, 90)).translate((-SPOT[0] - 1.0, SPOT[1], 0))
    box = Manifold.cube((LEFT[1] - LEFT[0], 12, HEIGHT)).translate((LEFT[0], -6, 0))
    found = judged(part_of("red", (box - cut).refine_to_length(0.25)), good("blue"))
    check = check_of(found, "red.wall")
    assert check.failed
    assert abs(check.where[0, 1] - SPOT[1]) < NEAR
    assert -SPOT[0] - 1.0 - NEAR < check.where[0, 0] < -SPOT[0] + 1.0 + NEAR
    assert found.parts["red"].wall_mm is not None
    assert found.parts["red"].wall_mm.min == pytest.approx(0.5, abs=0.02)


def waisted(name: str, *, waist: float, gap: float) -> Part:
    """Return a bar whose sides come nearest to each other at the spot, or with a gap the frame round it."""
    y = np.linspace(-5, 5, 201)
    half = waist / 2 + gap + 0.1 * (y - SPOT[1]) ** 2
    outline = np.concatenate([np.column_stack([half, y]), np.column_stack([-half, y])[::-1]])
    bar = Manifold.extrude(cross_section(outline), HEIGHT)
    if not gap:
        return part_of(name, bar)
    return part_of(name, Manifold.cube((30, 9.9, HEIGHT), True).translate((0, 0, HEIGHT / 2)) - bar)


def cross_section(outline: Floats) -> CrossSection:

    return CrossSection([outline])


def test_a_pinched_neck() -> None:
    found = judged(waisted("red", waist=0.7, gap=0.0), waisted("blue", waist=0.7, gap=GAP))
    check = check_of(found, "red.neck")
    assert check.failed
    neck = found.parts["red"].neck_mm
    assert neck is not None
    assert neck.min == pytest.approx(0.7, abs=0.01)
    assert abs(neck.at[1] - SPOT[1]) < NEAR
    assert abs(abs(neck.at[0]) - 0.35) < NEAR
    assert check_of(judged(waisted("red", waist=0.9, gap=0.0), waisted("blue", waist=0.9, gap=GAP)), "red.neck").ok


def test_a_gap_that_narrows_in_one_place() -> None:
    def bumped(points: Floats) -> Floats:
        wall = points[:, 0] > LEFT[1] - 1e-3
        points[wall, 0] += 0.12 * hill(points[wall]) * np.exp(-(((points[wall, 2] - 1.1) / 0.5) ** 2))
        return points

    red = slab("red", left=LEFT[0], right=LEFT[1], warp=bumped)
    truth = red.points[red.points[:, 0].argmax()]
    found = judged(red, good("blue"))
    check = check_of(found, "fit.gap")
    assert check.failed
    assert np.linalg.norm(check.where[0, 1:] - truth[1:]) < NEAR
    assert found.fit is not None
    assert found.fit.gap_mm is not None
    assert found.fit.gap_mm.min == pytest.approx(GAP - (truth[0] - LEFT[1]), abs=1e-5)
    assert found.fit.gap_mm.queried == pytest.approx(found.fit.gap_mm.min, rel=0.02)


@pytest.mark.parametrize(("lean", "code"), [(0.1, "fit.gap"), (-0.3, "fit.gap_max")])
def test_a_leaning_wall(lean: float, code: str) -> None:
    def leaning(points: Floats) -> Floats:
        wall = points[:, 0] > LEFT[1] - 1e-3
        points[wall, 0] += lean * hill(points[wall]) * points[wall, 2] / HEIGHT
        return points

    red = slab("red", left=LEFT[0], right=LEFT[1], warp=leaning)
    check = check_of(judged(red, good("blue"), middles=True), code)
    assert check.failed
    assert abs(check.where[0, 1] - SPOT[1]) < NEAR
    assert abs(check.where[0, 2] - (HEIGHT if lean > 0 else HEIGHT / 2)) < NEAR
    other = "fit.gap_max" if code == "fit.gap" else "fit.gap"
    assert check_of(judged(red, good("blue"), middles=True), other).ok


def at_spot(part: Part) -> int:
    """Return the triangle on top that is nearest to the spot."""
    middles = part.points[part.triangles].mean(axis=1)
    return int(np.linalg.norm(middles - [-SPOT[0], SPOT[1], HEIGHT], axis=1).argmin())


@pytest.mark.parametrize("code", ["red.closed", "red.oriented", "red.nondegenerate"])
def test_a_hole_a_turned_and_a_flat_triangle(code: str) -> None:
    red = good("red")
    triangles = red.triangles.copy()
    worst = at_spot(red)
    corners = red.points[triangles[worst]]
    if code == "red.closed":
        triangles = np.delete(triangles, worst, axis=0)
    elif code == "red.oriented":
        triangles[worst] = triangles[worst, ::-1]
    else:
        triangles = np.vstack([triangles, triangles[worst][[0, 1, 0]]])
    check = check_of(judged(Part("red", red.points, triangles), good("blue")), code)
    assert check.failed
    to_corners = np.linalg.norm(check.where[:, None] - corners.mean(axis=0), axis=2)
    assert to_corners.max() < NEAR + 0.1  # the edges of a triangle with sides of 0.2 mm


def test_triangles_that_cross() -> None:
    red = slab("red", left=LEFT[0], right=LEFT[1], fine=0.12)
    points = red.points.copy()
    spike = red.triangles[at_spot(red), 0]
    points[spike, 2] = -0.5  # through the bottom
    check = check_of(judged(Part("red", points, red.triangles), good("blue")), "red.self_intersections")
    assert check.failed
    assert np.linalg.norm(check.where[:, :2] - points[spike, :2], axis=1).min() < NEAR


def test_an_overlap() -> None:
    def bumped(points: Floats) -> Floats:
        wall = points[:, 0] > LEFT[1] - 1e-3
        points[wall, 0] += 0.4 * hill(points[wall]) * np.exp(-(((points[wall, 2] - 1.1) / 0.5) ** 2))
        return points

    red = slab("red", left=LEFT[0], right=LEFT[1], warp=bumped)
    truth = red.points[red.points[:, 0].argmax()]
    check = check_of(judged(red, good("blue")), "fit.overlap")
    assert check.failed
    assert np.linalg.norm(check.where[0] - truth) < 2 * NEAR  # the piece that both have is 0.5 mm wide
