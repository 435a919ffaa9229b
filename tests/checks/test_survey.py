"""Surveys: the same from other processes as from this one, and made here where those are of no use."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
import trimesh

from fabricate.checks import survey
from fabricate.checks.expectations import Expectations
from fabricate.checks.judge import judged_parts
from fabricate.checks.survey import Survey, surveyed, surveys_beside
from fabricate.solid.part import Part
from fabricate.triangles.normals import area_vectors
from fabricate.triangles.search_tree import SearchTree


def boxes(count: int) -> list[Part]:
    mesh = trimesh.creation.box((4, 5, 6)).subdivide()
    return [Part(f"box-{k}", mesh.vertices + np.array([4.3 * k, 0, 0]), mesh.faces) for k in range(count)]


def crossed(part: Part) -> Part:
    """Return the part with a corner pushed out through the opposite side."""
    points = np.array(part.points)
    points[0] = part.points.mean(axis=0) - 2.0 * (points[0] - part.points.mean(axis=0))
    return replace(part, points=points)


def here(parts: Sequence[Part]) -> list[Survey]:
    return [
        surveyed(part, SearchTree.of(part.points, part.triangles), area_vectors(part.points, part.triangles))
        for part in parts
    ]


@pytest.fixture
def large(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    """Let every part be large enough for processes of its own, on a computer that has room for them."""
    monkeypatch.setattr(survey, "WORTHWHILE", 0)
    monkeypatch.setattr(multiprocessing, "parent_process", lambda: None)
    monkeypatch.setattr(os, "getloadavg", lambda: (1.2, 0.0, 0.0))
    return monkeypatch


@pytest.mark.parametrize("processors", [2, 8])
def test_other_processes_find_the_same(large: pytest.MonkeyPatch, processors: int) -> None:
    large.setattr(os, "cpu_count", lambda: processors)
    first, second, third = boxes(3)
    parts = [first, crossed(second), third]
    with surveys_beside(parts) as awaited:
        found = awaited()
    assert found is not None
    for one, other in zip(found, here(parts), strict=True):
        assert np.array_equal(one.crossing, other.crossing)
        assert all(np.array_equal(array, getattr(other.walls, name)) for name, array in vars(one.walls).items())
    assert [len(each.crossing) > 0 for each in found] == [False, True, False]


def test_the_judgement_is_the_same(large: pytest.MonkeyPatch) -> None:
    large.setattr(os, "cpu_count", lambda: 2)
    parts = [*boxes(1), crossed(boxes(2)[1])]
    beside = judged_parts(parts, Expectations(clearance=0.3))
    large.setattr(os, "cpu_count", lambda: 1)
    alone = judged_parts(parts, Expectations(clearance=0.3))
    assert [(check.code, check.ok, check.message) for check in beside.checks] == [
        (check.code, check.ok, check.message) for check in alone.checks
    ]
    assert "box-1.self_intersections" in {check.code for check in beside.checks if check.failed}


@pytest.mark.parametrize("what", ["few triangles", "one processor", "busy", "in a worker"])
def test_no_process_is_begun_where_it_is_no_use(large: pytest.MonkeyPatch, what: str) -> None:
    large.setattr(os, "cpu_count", lambda: 1 if what == "one processor" else 2)
    if what == "few triangles":
        large.setattr(survey, "WORTHWHILE", 10_000)
    if what == "busy":
        large.setattr(os, "getloadavg", lambda: (2.6, 0.0, 0.0))
    if what == "in a worker":
        large.setattr(multiprocessing, "parent_process", multiprocessing.current_process)
    large.setattr(survey, "_begun", lambda *_: pytest.fail("a process was begun"))
    with surveys_beside(boxes(2)) as awaited:
        assert awaited() is None


def test_what_other_processes_do_not_manage_is_done_here(large: pytest.MonkeyPatch) -> None:
    large.setattr(os, "cpu_count", lambda: 2)
    large.setattr(survey, "WORK", "raise SystemExit(3)")
    with surveys_beside(boxes(1)) as awaited:
        assert awaited() is None
    assert judged_parts([crossed(boxes(1)[0])], Expectations(clearance=0.3)).parts["box-0"].self_intersections > 0


def test_without_room_for_another_process_all_is_done_here(large: pytest.MonkeyPatch) -> None:
    large.setattr(os, "cpu_count", lambda: 8)
    room = [1]
    start = survey._begun

    def begun(*given: object) -> object:
        if not room.pop():
            raise BlockingIOError
        room.append(0)
        return start(*given)  # type: ignore[arg-type]

    large.setattr(survey, "_begun", begun)
    with surveys_beside(boxes(2)) as awaited:
        assert awaited() is None


def test_processes_end_with_what_began_them(large: pytest.MonkeyPatch) -> None:
    large.setattr(os, "cpu_count", lambda: 2)
    large.setattr(survey, "WORK", "import time; time.sleep(600)")
    begun = []
    start = survey._begun
    large.setattr(survey, "_begun", lambda *given: begun.append(start(*given)) or begun[-1])
    with pytest.raises(KeyboardInterrupt), surveys_beside(boxes(1)):
        raise KeyboardInterrupt
    assert [child.poll() is not None for child in begun] == [True]
