"""Widening: narrow tiles grow where there is room, roomy tilings stay, hopeless ones do not hang."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from crowding import crowded_torus, roomy_torus

from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.errors import SolidError
from fabricate.mesh.torus import torus
from fabricate.prepare.triangle_mesh import TriangleMesh
from fabricate.surface.deviation import deviation
from fabricate.surface.limit import limit_vertices
from fabricate.surface.neck import NeckGauge
from fabricate.surface.tiling import smooth_surface
from fabricate.surface.widening import widened

RING = smooth_surface(torus(around=16, across=8, tube=0.45), size=60.0, round_limit=False)


def necks(quads: QuadMesh) -> np.ndarray:
    """Return the wider of the two necks that each tile can have."""
    return np.asarray(NeckGauge.of(quads, rings=(0.5,)).necks(quads.points).max(axis=1))


@pytest.fixture(scope="module")
def roomy() -> QuadMesh:
    return roomy_torus().quads


@pytest.fixture(scope="module")
def crowded() -> QuadMesh:
    return crowded_torus().quads


def off(quads: QuadMesh, surface: TriangleMesh) -> float:
    places = limit_vertices(quads)
    halves = quads.tiles[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)
    return deviation(places, halves, surface.points, surface.triangles).max


def test_narrow_tiles_grow_until_they_are_wide_enough(crowded: QuadMesh) -> None:
    before = necks(crowded)
    goal = 0.5 * float(np.median(before))
    assert before.min() < 0.5 * goal
    after = widened(crowded, RING, rings=(0.5,), neck=goal)
    assert necks(after).min() >= goal
    assert (after.tiles == crowded.tiles).all()
    assert off(after, RING) < 1.5


def test_a_roomy_tiling_stays_as_it_is(roomy: QuadMesh) -> None:
    assert widened(roomy, RING, rings=(0.5,), neck=0.5) is roomy


def test_a_tiling_with_too_many_narrow_tiles_stays_as_it_is(crowded: QuadMesh, monkeypatch: pytest.MonkeyPatch) -> None:
    goal = 0.5 * float(np.median(necks(crowded)))
    narrow = float((necks(crowded) < goal).mean())
    monkeypatch.setattr("fabricate.surface.widening.MOST_NARROW", 0.9 * narrow)
    assert widened(crowded, RING, rings=(0.5,), neck=goal) is crowded


def test_slides_that_tangle_the_surface_are_given_up(crowded: QuadMesh, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(*_: object) -> QuadMesh:
        raise SolidError("the smooth surface crosses itself")

    monkeypatch.setattr("fabricate.surface.widening.fitted", refused)
    goal = 0.5 * float(np.median(necks(crowded)))
    assert widened(crowded, RING, rings=(0.5,), neck=goal) is crowded


def test_what_cannot_be_had_is_not_asked_for(roomy: QuadMesh) -> None:
    """With necks far wider than tiles only those go on growing that are narrower than most."""
    after = widened(roomy, RING, rings=(0.5,), neck=100.0)
    assert necks(after).min() >= necks(roomy).min()
    assert np.median(necks(after)) == pytest.approx(np.median(necks(roomy)), rel=0.2)


def test_tiles_that_come_off_the_body_stay_where_they_were(crowded: QuadMesh, monkeypatch: pytest.MonkeyPatch) -> None:
    """A fit that draws every tile that moved off the body, in one half of it, leaves that half alone in the end."""
    half = crowded.points[:, 0] < 0.0

    def drawn_off(quads: QuadMesh, *_: object) -> QuadMesh:
        lost = half & (quads.points != crowded.points).any(axis=1)
        return replace(quads, points=np.where(lost[:, None], 0.5 * crowded.points, quads.points))

    monkeypatch.setattr("fabricate.surface.widening.fitted", drawn_off)
    before = necks(crowded)
    after = widened(crowded, RING, rings=(0.5,), neck=0.5 * float(np.median(before)))
    assert off(after, RING) < off(crowded, RING) + 1.0
    assert (after.points[half] == crowded.points[half]).all()
    assert (after.points[~half] != crowded.points[~half]).any()
