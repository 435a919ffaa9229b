"""Judging a wire: one tube passes, and what is no tube is found."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fabricate.checks.judged_wire import JudgedWire, judged_wire
from fabricate.output.stl import write_stl
from fabricate.process import PROCESSES
from fabricate.solid.part import Part
from fabricate.solid.wire import wire

ANGLE = np.linspace(0, 2 * np.pi, 60, endpoint=False)
RING = wire(
    np.stack([15 * np.cos(ANGLE), 10 * np.sin(ANGLE), np.sin(2 * ANGLE)], axis=1), diameter=1.5, tolerance=0.05
).part


def judged(part: Part, folder: Path) -> JudgedWire:
    write_stl(folder / "wire.stl", part)
    return judged_wire(folder / "wire.stl", diameter=1.5, length=80.0, process=PROCESSES["fdm"])


def failed(found: JudgedWire) -> set[str]:
    return {check.code for check in found.checks if check.failed}


def test_a_tube_passes_and_is_measured(tmp_path: Path) -> None:
    found = judged(RING, tmp_path)
    assert failed(found) == set()
    assert {check.code for check in found.checks} >= {"wire.genus", "wire.self_intersections", "wire.wall"}
    assert (found.facts.file, found.facts.genus, found.facts.watertight) == ("wire.stl", 1, True)
    assert (found.facts.diameter_mm, found.facts.length_mm) == (1.5, 80.0)
    assert found.facts.triangles == len(RING.triangles)
    assert found.facts.wall_mm is not None
    assert found.facts.wall_mm.median == pytest.approx(1.5, rel=0.03)


def test_a_hole_is_found(tmp_path: Path) -> None:
    assert "wire.closed" in failed(judged(replace(RING, triangles=RING.triangles[1:]), tmp_path))


def test_a_ball_is_no_wire(tmp_path: Path) -> None:
    corners = np.array([[0.0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]])
    ball = Part("wire", corners, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    assert failed(judged(ball, tmp_path)) == {"wire.genus"}


def test_a_wire_that_is_too_thin_for_the_process_is_found(tmp_path: Path) -> None:
    flat = replace(RING, points=RING.points * [1.0, 1.0, 0.2])
    assert "wire.wall" in failed(judged(flat, tmp_path))
