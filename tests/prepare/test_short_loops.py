"""Short loops go round handles and through holes, are as short as they can be, and part nothing."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus
from fabricate.prepare.short_loops import short_loops
from fabricate.prepare.triangle_mesh import edges, fanned

AROUND, ACROSS, TUBE = 40, 12, 0.2
RING = fanned(torus(around=AROUND, across=ACROSS, tube=TUBE))
SECTIONS = RING.points[: AROUND * ACROSS].reshape(AROUND, ACROSS, 3)
ROUND_THE_TUBE = np.linalg.norm(SECTIONS - np.roll(SECTIONS, -1, axis=1), axis=2).sum(axis=1).min()
THICK = float(np.linalg.norm(SECTIONS[:, 0] - SECTIONS[:, ACROSS // 2], axis=1).max())


def test_loops_round_a_tube_are_its_sections() -> None:
    loops = short_loops(RING, across=1.1 * THICK, longest=1.05 * ROUND_THE_TUBE)
    assert loops
    assert loops[0].length == pytest.approx(ROUND_THE_TUBE)
    assert [loop.length for loop in loops] == sorted(loop.length for loop in loops)
    assert len({loop.word for loop in loops}) == 1
    for loop in loops:
        ends = RING.points[loop.points], RING.points[np.roll(loop.points, -1)]
        assert np.linalg.norm(ends[1] - ends[0], axis=1).sum() == pytest.approx(loop.length)
        assert len(set(loop.points.tolist())) == len(loop.points)


def test_loops_run_along_edges() -> None:
    known = {tuple(ends) for ends in edges(RING).ends.tolist()}
    for loop in short_loops(RING, across=1.1 * THICK, longest=1.05 * ROUND_THE_TUBE):
        sides = np.sort(np.stack([loop.points, np.roll(loop.points, -1)], axis=1), axis=1)
        assert {tuple(side) for side in sides.tolist()} <= known


def test_there_are_none_where_handles_are_longer_round_or_wider() -> None:
    assert short_loops(RING, across=1.1 * THICK, longest=0.99 * ROUND_THE_TUBE) == []
    assert short_loops(RING, across=0.5 * THICK, longest=1.05 * ROUND_THE_TUBE) == []


def test_a_ball_has_none() -> None:
    assert short_loops(fanned(sphere(faces="triangles", frequency=4)), across=100.0, longest=100.0) == []
