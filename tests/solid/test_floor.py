"""Floors of solid cores: under a flat ceiling, under a bent one, and where facets do not match."""

from __future__ import annotations

import numpy as np
import pytest

import fabricate as fab
from fabricate.arrays import Floats, Indices
from fabricate.checks.geometry import as_manifold
from fabricate.mesh.torus import torus
from fabricate.solid.assembly import Core
from fabricate.solid.floor import floor_drop, lowered

CLEARANCE = 0.3


def sheet(count: int, height: Floats) -> tuple[Floats, Indices]:
    """Return a square grid of `count` points a side, 1 mm apart, at the given heights."""
    x, y = np.meshgrid(np.arange(count), np.arange(count), indexing="ij")
    points = np.stack([x.ravel(), y.ravel(), np.broadcast_to(height, x.shape).ravel()], axis=1).astype(float)
    corner = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    triangles = [[corner, corner + count, corner + count + 1], [corner, corner + count + 1, corner + 1]]
    return points, np.concatenate([np.stack(each, axis=1) for each in triangles])


def downwards(points: Floats) -> Floats:
    return np.broadcast_to(np.array([0.0, 0.0, -1.0]), points.shape)


def test_under_a_flat_ceiling_the_floor_is_a_clearance_deeper() -> None:
    points, triangles = sheet(5, np.zeros((5, 5)))
    assert floor_drop(points, triangles, downwards(points), clearance=CLEARANCE) == pytest.approx(CLEARANCE)


@pytest.mark.parametrize("slope", [0.3, 1.0])
def test_under_a_slope_it_lies_deeper_by_the_slope(slope: float) -> None:
    points, triangles = sheet(5, slope * np.arange(5.0)[:, None])
    drop = floor_drop(points, triangles, downwards(points), clearance=CLEARANCE)
    assert drop == pytest.approx(CLEARANCE * np.hypot(1.0, slope))


def test_a_floor_that_is_far_enough_stays() -> None:
    points, triangles = sheet(5, np.zeros((5, 5)))
    drop = np.full(len(points), CLEARANCE)
    floor = points + drop[:, None] * downwards(points)
    assert (lowered(drop, points, floor, triangles, clearance=CLEARANCE) == drop).all()


def test_a_bump_in_the_floor_is_lowered_and_what_is_far_from_it_is_not() -> None:
    points, triangles = sheet(9, np.zeros((9, 9)))
    drop = np.full(len(points), CLEARANCE)
    drop[40] = 0.1
    deeper = lowered(drop, points, points + drop[:, None] * downwards(points), triangles, clearance=CLEARANCE)
    assert deeper[40] == pytest.approx(1.5 * 0.1)
    assert deeper[0] == drop[0]


@pytest.mark.parametrize("core", ["blue", "yellow"])
def test_the_gap_is_kept_when_facets_are_as_coarse_as_it_is_wide(core: Core) -> None:
    quads = fab.tiled(fab.sized(torus(around=6, across=4, tube=0.45), size=60), tile_size=20)
    surface = fab.fitted_cut(fab.grown_duotone(quads, tree="random", seed=7), tolerance=0.3, clearance=CLEARANCE)
    yellow, blue = (
        as_manifold(part) for part in fab.solids(surface, thickness=2.0, clearance=CLEARANCE, core=core).parts
    )
    assert yellow.min_gap(blue, 1.2 * CLEARANCE) >= 0.95 * CLEARANCE
