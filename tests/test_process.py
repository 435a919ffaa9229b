"""The process table says what can be made, and its own defaults can be made by it."""

from typing import get_args

import pytest

from fabricate.process import PROCESSES, Process, ProcessName

ALL = pytest.mark.parametrize("process", PROCESSES.values(), ids=PROCESSES.keys())


def test_every_name_a_config_may_use_is_in_the_table() -> None:
    assert set(PROCESSES) == set(get_args(ProcessName))
    assert all(process.name == name for name, process in PROCESSES.items())


@ALL
def test_default_walls_are_no_thinner_than_the_thinnest(process: Process) -> None:
    assert 0 < process.wall_min <= process.wall_default
    assert process.feature_min > 0


@ALL
def test_default_gap_stays_open(process: Process) -> None:
    assert process.gap_default <= process.captive_gap
    assert process.gap_default > (process.crack_closed or 0)


def test_a_tight_gap_is_the_default_where_a_process_has_one() -> None:
    assert PROCESSES["fdm"].gap_default == PROCESSES["fdm"].tight_gap == 0.3
    assert PROCESSES["sla"].gap_default == PROCESSES["sla"].captive_gap == 0.25


def test_the_default_filament_wall_is_a_multiple_of_the_line() -> None:
    fdm = PROCESSES["fdm"]
    assert fdm.line_width is not None
    lines = fdm.wall_default / fdm.line_width
    assert lines == pytest.approx(round(lines))


def test_only_processes_that_trap_material_need_holes() -> None:
    assert {name for name, process in PROCESSES.items() if process.holes_min} == {"sla", "sls", "mjf"}
    assert all((process.hole_min is None) == (process.holes_min == 0) for process in PROCESSES.values())


def test_the_table_cannot_be_edited() -> None:
    with pytest.raises(TypeError):
        PROCESSES["fdm"] = PROCESSES["sla"]  # type: ignore[index]
    with pytest.raises(AttributeError):
        PROCESSES["fdm"].wall_min = 0.1  # type: ignore[misc]
