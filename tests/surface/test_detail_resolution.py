"""Resolution of detail: finer for larger tiles and finer targets, never finer than the finest detail."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.mesh.sphere import sphere
from fabricate.surface.cut import cut
from fabricate.surface.detail_resolution import EDGE_OF_SIDE, FINEST, detail_resolution
from fabricate.surface.limit import LimitSurface
from fabricate.surface.resolution import MIN_RESOLUTION
from fabricate.surface.sizing import tile_sides


def ball(subdivisions: int) -> tuple[np.ndarray, np.ndarray]:
    mesh = trimesh.creation.icosphere(subdivisions=subdivisions, radius=50)
    return np.array(mesh.vertices), np.array(mesh.faces)


@given(sides=st.tuples(st.floats(0.5, 50), st.floats(0.5, 50)))
def test_larger_tiles_need_no_less(sides: tuple[float, float]) -> None:
    small, large = (detail_resolution(*ball(3), tile_side=side) for side in sorted(sides))
    assert MIN_RESOLUTION <= small <= large


def test_a_finer_target_needs_no_less() -> None:
    found = [detail_resolution(*ball(level), tile_side=30.0) for level in (1, 2, 3, 4)]
    assert found == sorted(found)
    assert found[0] < found[-1]


def test_noise_finer_than_the_finest_detail_asks_for_nothing_more() -> None:
    points, triangles = ball(7)
    finest = FINEST * float(np.linalg.norm(np.ptp(points, axis=0)))
    assert detail_resolution(points, triangles, tile_side=10.0) == round(EDGE_OF_SIDE * 10.0 / finest)


@pytest.mark.parametrize("resolution", [3, 4, 6, 9])
def test_the_edges_of_a_tessellation_are_as_long_as_taken_for_granted(resolution: int) -> None:
    quads = subdivided(sphere(faces="triangles", frequency=3), levels=1)
    made = cut(random_duotone(quads, seed=1), LimitSurface.of(quads), rings=(0.5,), resolution=resolution)
    corners = made.points[made.triangles]
    edge = np.median(np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2))
    side = np.median(tile_sides(quads))
    assert edge == pytest.approx(EDGE_OF_SIDE * side / resolution, rel=0.2)
