"""The witness: its contacts stop whatever motion is tried, and none of them can be left out."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from joints import GAP, ball, case, curved_peg, half_balls, peg_in_hole, peg_with_heads, spacing
from scipy.optimize import linprog

from fabricate.arrays import Floats
from fabricate.checks.contacts import Contacts, contacts
from fabricate.checks.mobility import mobility, motion_rows
from fabricate.checks.witness import farthest, witness
from fabricate.solid.part import Part

AXES = np.vstack([np.eye(6), -np.eye(6)])


def proved(first: Part, second: Part) -> tuple[Contacts | None, Floats]:
    """Return the witness, and the rows of its motions."""
    met = contacts(spacing(first, second), clearance=GAP)
    found = mobility(met, first.points)
    proof = witness(met, found.pivot, found.radius)
    rows = np.zeros((0, 6)) if proof is None else motion_rows(proof, found.pivot, found.radius)
    return proof, rows


def reach(rows: Floats, direction: Floats) -> float:
    """Return how far a motion goes in a direction when every contact has a gap of 1; inf without end."""
    solved = linprog(-direction, A_ub=rows, b_ub=np.ones(len(rows)), bounds=(None, None))
    return np.inf if solved.status == 3 else float(-solved.fun)


def test_a_peg_with_heads_is_held_by_few_contacts() -> None:
    proof, rows = proved(*peg_with_heads())
    assert proof is not None
    assert 4 <= len(proof.gaps) <= 12
    straight = AXES[[0, 1, 2, 6, 7, 8]]
    assert np.isfinite([reach(rows, axis) for axis in straight]).all()
    for k in range(len(rows)):  # none can be left out
        left = np.delete(rows, k, axis=0)
        assert sum(reach(left, axis) for axis in straight) > sum(reach(rows, axis) for axis in straight)


def test_a_ball_in_a_shell_is_held_though_it_turns() -> None:
    proof, rows = proved(ball(10.0), case(10.0 + GAP))
    assert proof is not None
    assert len(proof.gaps) <= 12
    assert np.isfinite([reach(rows, axis) for axis in AXES[[0, 1, 2, 6, 7, 8]]]).all()


@pytest.mark.parametrize("joint", [half_balls(), peg_in_hole(round_one=True), curved_peg()])
def test_what_is_free_has_no_witness(joint: tuple[Part, Part]) -> None:
    assert proved(*joint)[0] is None


def test_without_contacts_there_is_no_witness() -> None:
    nothing = Contacts(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0))
    assert witness(nothing, np.zeros(3), 1.0) is None


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 1000))
def test_how_far_rows_let_a_motion_go_agrees_with_the_motions_themselves(seed: int) -> None:
    rows = np.random.default_rng(seed).normal(size=(13, 6))
    # Of 13 random rows a good part span everything (Wendel 1962).
    found = [farthest(rows, np.ones(13), axis)[0] for axis in AXES]
    assert found == pytest.approx([reach(rows, axis) for axis in AXES], rel=1e-6)
