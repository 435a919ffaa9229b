"""Printability: the limits of each process, met and just missed."""

from __future__ import annotations

import re

import numpy as np
import pytest
import trimesh

from fabricate.checks.check import Check
from fabricate.checks.expectations import Band, Neck
from fabricate.checks.facts import Narrowest
from fabricate.checks.printability import (
    band_check,
    neck_check,
    part_neck_check,
    process_gap_check,
    wall_check,
)
from fabricate.checks.walls import Walls, walls
from fabricate.process import PROCESSES, Process
from fabricate.solid.part import Part
from fabricate.triangles.normals import area_vectors
from fabricate.triangles.search_tree import SearchTree

FDM = PROCESSES["fdm"]
AT = (1.0, 2.0, 3.0)

every_process = pytest.mark.parametrize("process", PROCESSES.values(), ids=PROCESSES)


def measured(part: Part) -> Walls:
    tree = SearchTree.of(part.points, part.triangles)
    return walls(part, tree, area_vectors(part.points, part.triangles))


def wall(thickness: float, process: Process | None) -> Check:
    mesh = trimesh.creation.box((10, 10, thickness))
    part = Part("red", mesh.vertices, mesh.faces)
    return wall_check(part, measured(part), process=process)


@every_process
def test_walls_are_held_against_the_process(process: Process) -> None:
    assert wall(1.01 * process.wall_min, process).ok
    thin = wall(0.99 * process.wall_min, process)
    assert thin.failed
    assert thin.code == "red.wall"
    assert f"{process.wall_min:g} mm" in thin.message
    assert np.allclose(np.abs(thin.where[:, 2]), 0.99 * process.wall_min / 2, rtol=1e-6)


def test_a_wall_just_too_thin_is_told_from_the_limit() -> None:
    thin = wall(FDM.wall_min - 1e-5, FDM)
    assert thin.failed
    assert "the thinnest is 0.79999 mm" in thin.message


def test_a_thin_place_is_not_called_no_share_of_the_surface() -> None:
    """A notch in a thick wall is thin in a place without any measured area."""
    found = Walls(np.array([0.5, 2.0]), np.zeros((2, 3)), np.array([0.0, 1.0]), np.zeros((2, 2), dtype=np.int64))
    message = wall_check(Part("red", np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)), found, process=FDM).message
    assert "less than 0.01% of the surface is thinner" in message


def test_without_a_process_the_wall_is_said_but_not_judged() -> None:
    unknown = wall(0.1, None)
    assert unknown.skipped
    assert "0.1 mm" in unknown.message


def test_without_opposite_faces_there_is_no_wall_to_judge() -> None:
    corners = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], dtype=float)
    part = Part("red", corners, np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]))
    assert wall_check(part, measured(part), process=FDM).skipped


@every_process
def test_necks_of_finished_parts_are_held_against_the_process(process: Process) -> None:
    wide = part_neck_check("red", Narrowest(process.feature_min, AT), process=process)
    assert wide.ok
    assert wide.code == "red.neck"
    narrow = part_neck_check("red", Narrowest(0.9999 * process.feature_min, AT), process=process)
    assert narrow.failed
    assert narrow.where.tolist() == [list(AT)]
    assert "(1, 2, 3)" in narrow.message


def test_necks_that_are_not_known_are_not_judged() -> None:
    assert part_neck_check("red", None, process=FDM).skipped
    assert part_neck_check("red", Narrowest(0.1, AT), process=None).skipped


@every_process
def test_clearance_is_taken_off_the_neck(process: Process) -> None:
    neck = Neck(process.feature_min + 0.3, AT)
    assert neck_check(neck, clearance=0.29, process=process).ok
    narrow = neck_check(neck, clearance=0.31, process=process)
    assert narrow.failed
    assert narrow.where.tolist() == [list(AT)]
    assert "(1, 2, 3)" in narrow.message


@pytest.mark.parametrize(
    ("neck", "clearance", "process"),
    [(None, 0.3, FDM), (Neck(1.0, AT), None, FDM), (Neck(1.0, AT), 0.3, None)],
)
def test_necks_are_not_judged_without_all_figures(
    neck: Neck | None, clearance: float | None, process: Process | None
) -> None:
    assert neck_check(neck, clearance=clearance, process=process).skipped


@every_process
def test_a_narrow_band_says_how_far_apart_its_rings_would_have_to_be(process: Process) -> None:
    needed = process.feature_min + 0.3
    assert band_check(Band("band-2", 1.001 * needed, AT, 0.2), clearance=0.3, process=process).ok
    narrow = band_check(Band("band-2", needed / 1.2, AT, 0.2), clearance=0.3, process=process)
    assert (narrow.code, narrow.failed) == ("pattern.band", True)
    assert "band-2" in narrow.message
    assert "tiles 1.2 times as large" in narrow.message or "tiles 1.21 times as large" in narrow.message
    said = re.search(r"at least (0\.\d+) apart there instead of 0\.2", narrow.message)
    assert said is not None
    assert 0.24 - 1e-9 <= float(said[1]) < 0.2415
    assert narrow.where.tolist() == [list(AT)]


@pytest.mark.parametrize(("clearance", "process"), [(None, FDM), (0.3, None)])
def test_bands_are_not_judged_without_all_figures(clearance: float | None, process: Process | None) -> None:
    assert band_check(Band("band-1", 1.0, AT, 0.2), clearance=clearance, process=process).skipped


@every_process
def test_the_gap_of_the_process_prints_loose(process: Process) -> None:
    found = process_gap_check(process.captive_gap, process=process)
    assert found.ok
    assert "loose" in found.message
    assert "tight" not in found.message


@every_process
def test_a_smaller_gap_passes_and_is_called_tight(process: Process) -> None:
    found = process_gap_check(0.9 * process.captive_gap, process=process)
    assert found.ok
    assert "tight" in found.message
    assert f"{process.captive_gap:g} mm" in found.message


def test_a_gap_that_slicers_close_fails() -> None:
    assert process_gap_check(0.0979, process=FDM).failed
    assert process_gap_check(0.098, process=FDM).ok


def test_gaps_between_tight_and_closed_are_said_to_stick() -> None:
    assert "well-tuned" in process_gap_check(0.3, process=FDM).message
    assert "force" in process_gap_check(0.2, process=FDM).message


@pytest.mark.parametrize(("clearance", "process"), [(None, FDM), (0.3, None), (0.0, FDM)])
def test_the_gap_is_not_judged_where_there_is_nothing_to_judge(
    clearance: float | None, process: Process | None
) -> None:
    assert process_gap_check(clearance, process=process).skipped
