"""Draining: openings as large and as many as each process needs, just missed, and not asked for."""

from __future__ import annotations

import pytest

from fabricate.checks.draining import draining_checks, draining_notes
from fabricate.checks.facts import OpeningFacts
from fabricate.process import PROCESSES, Process

NEEDY = pytest.mark.parametrize(
    "process", [PROCESSES[name] for name in ("sla", "sls", "mjf")], ids=lambda each: each.name
)


def openings(diameter: float, count: int) -> list[OpeningFacts]:
    return [OpeningFacts("yellow", diameter, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0))] * count


@NEEDY
def test_what_the_process_needs_passes(process: Process) -> None:
    assert process.hole_min is not None
    (check,) = draining_checks(openings(process.hole_min, process.holes_min), process=process)
    assert (check.code, check.ok) == ("finish.openings", True)
    assert "ask for" not in check.message


@NEEDY
def test_too_small_and_too_few_fail_and_say_what_to_ask_for(process: Process) -> None:
    assert process.hole_min is not None
    advice = f'diameter = "{process.hole_min:g} mm", count = {process.holes_min}'
    (small,) = draining_checks(openings(process.hole_min - 1e-5, process.holes_min), process=process)
    assert small.failed
    assert advice in small.message
    assert f"{process.hole_min - 1e-5:.6g} mm" in small.message
    if process.holes_min > 1:
        (few,) = draining_checks(openings(process.hole_min, process.holes_min - 1), process=process)
        assert few.failed
        assert advice in few.message


def test_only_openings_that_are_wide_enough_count() -> None:
    mjf = PROCESSES["mjf"]
    assert draining_checks([*openings(2.0, 2), *openings(1.5, 1)], process=mjf)[0].ok
    assert draining_checks([*openings(2.0, 1), *openings(1.5, 1)], process=mjf)[0].failed


@NEEDY
def test_a_hollow_without_openings_is_a_note_and_no_failure(process: Process) -> None:
    assert draining_checks([], process=process) == ()
    (note,) = draining_notes([], core="hollow", process=process)
    assert f"{process.hole_min:g} mm" in note
    assert "solid.openings" in note
    assert draining_notes([], core="blue", process=process) == ()
    assert draining_notes(openings(1.0, 1), core="hollow", process=process) == ()


def test_filament_leaves_nothing_inside() -> None:
    assert draining_checks(openings(1.0, 1), process=PROCESSES["fdm"]) == ()
    assert draining_notes([], core="hollow", process=PROCESSES["fdm"]) == ()
