"""Holding: joints that come apart, catch or are one, each with its proof."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from joints import (
    GAP,
    ball,
    case,
    curved_peg,
    half_balls,
    part_of,
    peg_in_hole,
    peg_with_heads,
    ridged_peg,
    spacing,
    turned,
)
from manifold3d import Manifold

from fabricate.checks.facts import Play
from fabricate.checks.geometry import as_manifold
from fabricate.checks.holding import Holding, holding, holding_check
from fabricate.solid.part import Part


def held(first: Part, second: Part) -> Holding:
    return holding(spacing(first, second), as_manifold(first), as_manifold(second), clearance=GAP)


@settings(max_examples=5, deadline=None)
@given(st.floats(0.0, 3.0), st.tuples(*3 * [st.floats(0.1, 1.0)]))
def test_halves_of_a_ball_come_apart_however_they_lie(angle: float, axis: tuple[float, float, float]) -> None:
    first, second = half_balls()
    assert held(turned(first, angle, axis), turned(second, angle, axis)).verdict == "separable"


@pytest.mark.parametrize("joint", [peg_in_hole(round_one=True), peg_in_hole(round_one=False)[::-1], curved_peg()])
def test_pegs_come_out_of_their_holes(joint: tuple[Part, Part]) -> None:
    assert held(*joint).verdict == "separable"


def test_a_slanted_peg_comes_out_too() -> None:
    peg, plate = (turned(part, 0.7, (1, 2, 3)) for part in peg_in_hole(round_one=False))
    assert held(peg, plate).verdict == "separable"


@pytest.mark.parametrize("joint", [peg_with_heads(), ridged_peg(), (ball(10.0), case(10.0 + GAP))])
def test_what_is_caught_has_a_witness(joint: tuple[Part, Part]) -> None:
    found = held(*joint)
    assert found.verdict == "captive"
    facts = found.witness_facts
    assert facts is not None
    assert 4 <= len(facts.points) == len(facts.normals) <= 12
    assert np.linalg.norm(facts.normals, axis=1) == pytest.approx(1.0)


def test_loose_links_of_a_chain_are_neither_proved_free_nor_caught() -> None:
    link = trimesh.creation.torus(10, 2, major_sections=24, minor_sections=12)
    other = link.copy()
    other.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, (1, 0, 0)))
    other.apply_translation((10, 0, 0))
    first, second = Part("red", link.vertices, link.faces), Part("blue", other.vertices, other.faces)
    found = held(first, second)
    assert found.verdict is None
    check = holding_check("fit.mobility", first, second, found, expected="captive")
    assert check.failed
    assert "overlaps the other before it is out" in check.message


def test_a_peg_behind_a_lid_is_not_proved_free() -> None:
    peg, plate = Manifold.cylinder(20, 5, 5, 64, True), Manifold.cube((30, 30, 8), True)
    cage = Manifold.cube((34, 34, 60), True) - Manifold.cube((30, 30, 56), True)
    box = part_of(plate - Manifold.cylinder(40, 5 + GAP, 5 + GAP, 64, True) + cage)
    assert held(part_of(peg), box).verdict is None


def test_verdicts_are_compared_with_what_is_expected() -> None:
    red, blue = ball(1.0), ball(2.0)
    loose = Holding("separable", Play(*6 * [np.inf]))
    caught = held(*peg_with_heads())
    assert holding_check("fit.mobility", red, blue, loose, expected="separable").ok
    assert holding_check("fit.mobility", red, blue, Holding("fused"), expected="fused").ok
    good = holding_check("fit.mobility", red, blue, caught, expected="captive")
    assert good.ok
    assert caught.witness is not None
    assert np.array_equal(good.where, caught.witness.points)
    failed = holding_check("fit.mobility", red, blue, loose, expected="captive")
    assert failed.failed
    assert "moved out" in failed.message
