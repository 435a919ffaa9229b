"""Pairs: what is built once per part, and what is left out of parts that are no solids."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from joints import GAP, peg_with_heads

from fabricate.checks.check import Check
from fabricate.checks.expectations import Expectations
from fabricate.checks.geometry import as_manifold
from fabricate.checks.pairs import Solid, fit
from fabricate.solid.part import Part
from fabricate.triangles.search_tree import SearchTree


def box(name: str, x: float) -> Part:
    mesh = trimesh.creation.box((1, 1, 1))
    return Part(name, mesh.vertices + np.array([x, 0, 0]), mesh.faces)


def solids(*parts: Part) -> dict[str, Solid]:
    return {part.name: Solid(part, as_manifold(part), SearchTree.of(part.points, part.triangles)) for part in parts}


def test_every_pair_of_three_is_judged() -> None:
    parts = [box(name, 1.3 * k) for k, name in enumerate("abc")]
    made = fit(parts, solids(*parts), Expectations(clearance=0.3))
    assert [check.code for check in made.checks if check.ok] == [
        "fit.a-b.overlap", "fit.a-b.gap", "fit.a-c.overlap", "fit.a-c.gap", "fit.b-c.overlap", "fit.b-c.gap",
        "fit.joined",
    ]  # fmt: skip


def test_what_faces_any_neighbour_belongs_to_a_joint() -> None:
    parts = [box(name, 1.3 * k) for k, name in enumerate("abc")]
    made = fit(parts, solids(*parts), Expectations(clearance=0.3))
    facing = {
        name: sum(int(joint.among(np.arange(12)).sum()) for joint in joints) for name, joints in made.joints.items()
    }
    assert facing == {"a": 2, "b": 4, "c": 2}


def test_what_is_no_solid_is_named() -> None:
    a, b, c = (box(name, 1.3 * k) for k, name in enumerate("abc"))
    made = fit([a, b, c], solids(a, c), Expectations(clearance=0.3))
    spoiled = [check for check in made.checks if "b" in check.code.split(".")[1].split("-")]
    assert all(check.skipped and "because b is no solid" in check.message for check in spoiled)
    assert made.facts.gap_mm is not None
    assert made.facts.gap_mm.min == pytest.approx(1.6)


def test_boxes_in_a_row_come_apart() -> None:
    parts = box("a", 0.0), box("b", 1.3)
    made = fit(parts, solids(*parts), Expectations(clearance=0.3))
    assert made.facts.verdict == "separable"
    assert [check.code for check in made.checks if check.failed] == ["fit.mobility"]


def judged(first: Part, second: Part, clearance: float) -> dict[str, Check]:
    made = fit([first, second], solids(first, second), Expectations(clearance=clearance))
    return {check.code: check for check in made.checks}


def test_parts_that_share_a_face_are_fused() -> None:
    found = judged(box("a", 0.0), box("b", 1.0), 0.0)
    assert found["fit.gap"].ok
    assert "share 1 mm2" in found["fit.gap"].message
    assert found["fit.mobility"].ok


@pytest.mark.parametrize("x", [500.0, 1.3, 1.001])
def test_parts_that_are_apart_are_not_fused_whatever_the_clearance(x: float) -> None:
    found = judged(box("a", 0.0), box("b", x), 0.0)
    assert found["fit.gap"].failed
    assert f"{x - 1.0:.4g} mm" in found["fit.gap"].message
    assert found["fit.mobility"].failed


def test_parts_that_touch_along_an_edge_only_are_not_fused() -> None:
    corner = Part("b", box("b", 1.0).points + np.array([0.0, 1.0, 0.0]), box("b", 1.0).triangles)
    found = judged(box("a", 0.0), corner, 0.0)
    assert found["fit.gap"].failed
    assert "share none" in found["fit.gap"].message
    assert found["fit.mobility"].failed


def test_contacts_are_looked_for_as_far_as_the_gap_is_wide() -> None:
    red, blue = peg_with_heads()
    found = judged(Part("a", red.points, red.triangles), blue, GAP / 4)
    assert found["fit.mobility"].ok
    assert "captive" in found["fit.mobility"].message


def test_a_part_without_neighbours_is_not_joined_to_the_others() -> None:
    parts = box("a", 0.0), box("b", 1.0), box("c", 9.0)
    near, far = (
        {check.code: check for check in fit(each, solids(*each), Expectations(clearance=0.0)).checks}
        for each in ([*parts[:2], box("c", 2.0)], parts)
    )
    assert near["fit.joined"].ok
    assert far["fit.joined"].failed
    assert "2 groups" in far["fit.joined"].message
