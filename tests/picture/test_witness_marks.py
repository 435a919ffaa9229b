"""Marks of a witness: closed arrows that stand where the contacts are and point where they point."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from fabricate.checks.facts import PairFacts, Witness
from fabricate.picture.witness_marks import LENGTH, NAME, witness_marks
from fabricate.solid.part import Part

POINTS = ((1.0, 2.0, 3.0), (-4.0, 0.0, 5.0), (0.0, 0.0, -9.0))
NORMALS = ((1.0, 0.0, 0.0), (0.0, 0.6, -0.8), (0.0, 0.0, 1.0))


def ball(name: str) -> Part:
    mesh = trimesh.creation.icosphere(subdivisions=1, radius=10)
    return Part(name, mesh.vertices, mesh.faces)


def facts(witness: Witness | None) -> PairFacts:
    return PairFacts(gap_mm=None, overlap_mm3=None, verdict=None, play_mm=None, witness=witness)


def test_each_contact_has_a_closed_arrow_along_its_normal() -> None:
    parts = [ball("yellow"), ball("blue")]
    marks = witness_marks(parts, {"yellow-blue": facts(Witness(POINTS, NORMALS))})
    assert list(marks) == ["yellow"]
    assert marks["yellow"].name == NAME
    arrows = trimesh.Trimesh(marks["yellow"].points, marks["yellow"].triangles, process=False).split()
    assert len(arrows) == 3
    length = LENGTH * float(np.linalg.norm(np.ptp(parts[0].points, axis=0)))
    for foot, way in zip(POINTS, NORMALS, strict=True):
        (own,) = [arrow for arrow in arrows if np.linalg.norm(arrow.vertices - foot, axis=1).min() < 1e-4]
        assert own.is_watertight
        assert own.volume > 0.0
        along = (own.vertices - foot) @ np.array(way)
        assert (along.min(), along.max()) == (pytest.approx(0.0, abs=1e-4), pytest.approx(length, rel=1e-4))


def test_pairs_without_a_witness_have_no_marks() -> None:
    assert not witness_marks([ball("yellow"), ball("blue")], {"yellow-blue": facts(None)})


def test_marks_stand_on_the_first_part_of_each_pair() -> None:
    parts = [ball(name) for name in ("yellow", "band-1", "band-10", "blue")]
    one = Witness(POINTS[:1], NORMALS[:1])
    pairs = {"band-1-band-10": facts(one), "band-10-blue": facts(Witness(POINTS, NORMALS))}
    marks = witness_marks(parts, pairs)
    assert {name: len(mark.points) for name, mark in marks.items()} == {"band-1": 50, "band-10": 150}
