"""Walls are shallower where a neck would be too narrow at their depth, and nowhere else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.solid.neck_depth import SLOPE, thickness_for_necks
from fabricate.surface.cut import CutSurface, cut
from fabricate.surface.limit import LimitSurface
from fabricate.surface.neck import tile_necks
from fabricate.surface.sizing import sized, tiled
from fabricate.triangles.adjacency import undirected_edges


@pytest.fixture(scope="module")
def ball() -> CutSurface:
    quads = tiled(sized(geodesic_sphere(frequency=2), size=20), tile_size=3)
    return cut(grown_duotone(quads, tree="random", seed=1), LimitSurface.of(quads), rings=(0.5,), resolution=4)


def test_wide_necks_change_nothing(ball: CutSurface) -> None:
    assert thickness_for_necks(ball, 2.0, neck=0.1, least=1.0) == 2.0


def test_a_neck_that_narrows_on_its_way_down_gets_a_shallower_wall(ball: CutSurface) -> None:
    neck = 0.9 * float(tile_necks(ball)[0].min())  # 2 mm under a ball of radius 10 mm it is a fifth narrower
    thickness = np.asarray(thickness_for_necks(ball, 2.0, neck=neck, least=0.5))
    assert thickness.shape == (len(ball.points),)
    assert 0.5 <= thickness.min() < 1.5
    assert thickness.max() <= 2.0
    deep = replace(ball, points=ball.points - thickness[:, None] * ball.normals)
    assert tile_necks(deep)[0].min() >= 0.99 * neck
    assert tile_necks(replace(ball, points=ball.points - 2.0 * ball.normals))[0].min() < 0.95 * neck


def test_it_is_no_thinner_than_the_least_and_no_thicker_than_asked(ball: CutSurface) -> None:
    neck = float(np.median(tile_necks(ball)[0]))
    assert np.min(thickness_for_necks(ball, 2.0, neck=neck, least=1.7)) == pytest.approx(1.7)
    asked = np.linspace(1.0, 2.0, len(ball.points))
    limited = thickness_for_necks(ball, asked, neck=neck, least=1.7)
    assert (limited <= asked).all()


def test_it_changes_gently(ball: CutSurface) -> None:
    neck = float(np.quantile(tile_necks(ball)[0], 0.3))
    thickness = np.asarray(thickness_for_necks(ball, 2.0, neck=neck, least=0.5))
    first, second = undirected_edges(ball.triangles).T
    span = np.linalg.norm(ball.points[first] - ball.points[second], axis=1)
    assert (np.abs(thickness[first] - thickness[second]) <= SLOPE * span + 1e-9).all()
    assert np.ptp(thickness) > 0.1
