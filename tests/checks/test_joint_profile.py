"""What is measured of a joint is what was asked for, and a ridge that passes through the gap is found."""

from __future__ import annotations

import pytest

from fabricate.checks.facts import JointFacts, Spread
from fabricate.checks.joint_profile import joint_checks, joint_facts
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.torus import torus
from fabricate.solid.joint import STRAIGHT, Joint
from fabricate.solid.settling import fitted_cut
from fabricate.solid.solids import solids
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled

TONGUE = Joint(kind="tongue", height=0.4, width=1.2)


@pytest.fixture(scope="module")
def surface() -> CutSurface:
    quads = tiled(sized(torus(around=16, across=8, tube=0.45), size=80), tile_size=14)
    return fitted_cut(grown_duotone(quads, tree="random", seed=7), rings=(0.5,), tolerance=0.5, clearance=0.3)


@pytest.mark.parametrize("joint", [STRAIGHT, Joint(kind="draft", angle=8.0), Joint(kind="draft", angle=-6.0), TONGUE])
@pytest.mark.parametrize("clearance", [0.0, 0.3])
def test_sizes_are_measured(surface: CutSurface, joint: Joint, clearance: float) -> None:
    found = joint_facts(surface, solids(surface, thickness=2.4, clearance=clearance, joint=joint), joint.kind)
    assert found.kind == joint.kind
    assert found.lean_deg == pytest.approx(joint.angle or 0.0, abs=0.8)
    if joint is not TONGUE:
        assert (found.ridge_mm, found.width_mm) == (None, None)
        return
    assert found.ridge_mm is not None
    assert found.ridge_mm.median == pytest.approx(0.4, rel=0.05)
    assert 0.0 <= found.ridge_mm.min <= found.ridge_mm.median
    assert found.width_mm == pytest.approx(1.2, rel=0.02)


def ridge(height: float) -> JointFacts:
    return JointFacts("tongue", 0.0, Spread(0.1, height), 1.2)


@pytest.mark.parametrize(("height", "ok"), [(0.31, True), (0.3, False), (0.25, False)])
def test_a_ridge_has_to_be_higher_than_the_gap(height: float, ok: bool) -> None:
    (check,) = joint_checks(ridge(height), clearance=0.3)
    assert (check.code, check.ok, check.skipped) == ("fit.ridge", ok, False)
    assert f"{height:g} mm" in check.message
    assert ("solid.clearance" in check.message) == (not ok)


def test_where_there_is_no_ridge_or_no_gap_nothing_is_checked() -> None:
    assert joint_checks(JointFacts("draft", 3.0), clearance=0.3) == ()
    assert joint_checks(ridge(0.4), clearance=0.0) == ()
