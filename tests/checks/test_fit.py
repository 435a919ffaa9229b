"""Fit: common volumes, gaps against the clearance, and volumes that do or don't add up."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from fabricate.checks.check import Check
from fabricate.checks.facts import Gap, Spaces
from fabricate.checks.fit import gap_check, overlap_check, whole_check, widest_gap_check
from fabricate.checks.geometry import as_manifold, signed_volume
from fabricate.solid.part import Part


def box(name: str, size: float = 1.0, *, x: float = 0.0) -> Part:
    mesh = trimesh.creation.box((size, size, size))
    return Part(name, mesh.vertices + np.array([x, 0, 0]), mesh.faces)


def overlap(first: Part, second: Part) -> Check:
    return overlap_check(
        "fit.overlap",
        first,
        second,
        as_manifold(first) ^ as_manifold(second),
        smaller_volume=min(signed_volume(first), signed_volume(second)),
    )


@pytest.mark.parametrize("x", [1.0, 1.25, 40.0])
def test_boxes_beside_each_other_do_not_overlap(x: float) -> None:
    found = overlap(box("red"), box("green", x=x))
    assert found.ok
    assert len(found.where) == 0


def test_boxes_within_each_other_overlap_where_they_do() -> None:
    found = overlap(box("red"), box("green", x=0.75))
    assert found.failed
    assert "0.25 mm3" in found.message
    assert len(found.where) == 1
    assert (np.abs(found.where[0] - [0.375, 0, 0]) <= [0.125, 0.5, 0.5]).all()


def test_overlaps_are_named_from_the_largest_on() -> None:
    shifts = [np.array([3 * k, 0, 0.1 * k]) for k in range(3)]
    mesh = trimesh.creation.box()
    comb = Part(
        "red",
        np.concatenate([mesh.vertices + shift for shift in shifts]),
        np.concatenate([mesh.faces + 8 * k for k in range(3)]),
    )
    found = overlap(comb, Part("green", *_plate()))
    assert found.failed
    assert (found.where[:, 0] / 3).round().tolist() == [0, 1, 2]


def test_the_place_of_a_bent_overlap_is_in_it() -> None:
    ring = trimesh.creation.annulus(4.0, 5.0, 1.0)  # the middle of its bounding box is in its hole
    found = overlap(Part("red", ring.vertices, ring.faces), Part("green", *_plate()))
    assert 3.9 < np.linalg.norm(found.where[0, :2]) <= 5.0


def _plate() -> tuple[np.ndarray, np.ndarray]:
    mesh = trimesh.creation.box((40, 40, 1))
    return mesh.vertices - np.array([0, 0, 0.7]), mesh.faces


def test_a_millionth_of_the_smaller_part_is_no_overlap() -> None:
    red, green = box("red"), box("green", 10.0)
    common = as_manifold(box("slice", 0.01))
    assert overlap_check("fit.overlap", red, green, common, smaller_volume=1.001).ok
    assert overlap_check("fit.overlap", red, green, common, smaller_volume=0.99).failed


def gap(width: float, clearance: float | None) -> Check:
    return gap_check("fit.gap", box("red"), box("green"), Gap(width, (1.0, 2.0, 3.0)), clearance=clearance)


def test_a_gap_of_95_percent_is_enough_and_less_is_not() -> None:
    assert gap(0.3, 0.3).ok
    assert gap(0.95 * 0.3, 0.3).ok
    small = gap(0.2849, 0.3)
    assert small.failed
    assert "0.285 mm" in small.message
    assert "0.2849 mm" in small.message
    assert "(1, 2, 3)" in small.message
    assert small.where.tolist() == [[1, 2, 3]]


def test_without_a_clearance_the_gap_is_said_but_not_judged() -> None:
    unknown = gap(0.123, None)
    assert unknown.skipped
    assert "0.123 mm" in unknown.message


@pytest.mark.parametrize(("width", "shared", "ok"), [(0.0, 2.5, True), (0.0, 0.0, False), (0.3, 0.0, False)])
def test_parts_that_are_to_be_one_must_share_faces(width: float, shared: float, ok: bool) -> None:
    at = (1.0, 2.0, 3.0) if width else None
    touching = gap_check("fit.gap", box("red"), box("green"), Gap(width, at), clearance=0.0, shared=shared)
    assert touching.ok is ok
    assert not touching.skipped
    assert ("0.3 mm, at (1, 2, 3)" in touching.message) == (width > 0.0)


def test_parts_that_overlap_are_said_to() -> None:
    over = Gap(0.0, (1.0, 2.0, 3.0), queried=0.1)
    found = gap_check("fit.gap", box("red"), box("green"), over, clearance=0.3, common=0.5)
    assert found.failed
    assert "overlap: 0.5 mm3" in found.message
    assert found.where.tolist() == [[1, 2, 3]]


def whole(parts: tuple[Part, ...], space: Part, shell: Part) -> Check:
    volumes = {part.name: signed_volume(part) for part in parts}
    return whole_check("fit.whole", volumes, Spaces(signed_volume(space), signed_volume(shell)))


@pytest.mark.parametrize(
    ("tolerance", "advice"),
    [(0.05, "solid.tolerance smaller than 0.05 mm"), (0.005, "larger pattern.tile_size"), (None, "larger")],
)
def test_a_gap_too_wide_says_what_to_do(tolerance: float | None, advice: str) -> None:
    wide = Gap(0.3, None, max=0.45, max_at=(1.0, 2.0, 3.0))
    found = widest_gap_check("fit.gap_max", box("red"), box("green"), wide, clearance=0.3, tolerance=tolerance)
    assert found.failed
    assert f"ask for a {advice}" in found.message
    assert ("solid.tolerance" in found.message) == (tolerance == 0.05)
    good = replace(wide, max=0.38)
    assert "ask" not in widest_gap_check("fit.gap_max", box("red"), box("green"), good, clearance=0.3).message


def hollow(name: str, outer: float, inner: float) -> Part:
    big, small = box(name, outer), box(name, inner)
    return Part(
        name,
        np.concatenate([big.points, small.points]),
        np.concatenate([big.triangles, small.triangles[:, ::-1] + len(big.points)]),
    )


@pytest.mark.parametrize(("core", "ok"), [(8.0, True), (8.004, True), (8.03, False), (7.97, False)])
def test_core_gap_and_case_add_up_to_the_whole(core: float, ok: bool) -> None:
    parts = box("red", core), hollow("green", 12.0, 9.0)
    found = whole(parts, hollow("gap", 9.0, 8.0), box("shell", 12.0))
    assert found.ok is ok
    assert not found.skipped
    assert "1728 mm3" in found.message


def test_parts_that_touch_add_up_without_a_gap() -> None:
    nothing = Part("gap", np.zeros((0, 3)), np.zeros((0, 3), dtype=int))
    parts = box("red", 9.0), hollow("green", 12.0, 9.0)
    assert whole(parts, nothing, box("shell", 12.0)).ok
    assert whole(parts[:1], nothing, box("shell", 12.0)).failed
