"""Pairs: what is built once per part, and what is left out of parts that are no solids."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

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
    ]  # fmt: skip


def test_what_faces_any_neighbour_belongs_to_a_joint() -> None:
    parts = [box(name, 1.3 * k) for k, name in enumerate("abc")]
    made = fit(parts, solids(*parts), Expectations(clearance=0.3))
    assert {name: int(joint.sum()) for name, joint in made.joints.items()} == {"a": 2, "b": 4, "c": 2}


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
