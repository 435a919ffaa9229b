"""Tiles that slide: along creases, never across them, and darts and corners stay."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from crowding import crowded_box

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.mesh.torus import torus
from fabricate.surface.sizing import sized
from fabricate.surface.tile_sliding import slid_tiles


@pytest.fixture(scope="module")
def box() -> QuadMesh:
    return crowded_box().quads


def everywhere(quads: QuadMesh) -> np.ndarray:
    return np.ones(len(quads.tiles), dtype=bool)


def test_nothing_chosen_moves_nothing(box: QuadMesh) -> None:
    assert (slid_tiles(box, ~everywhere(box)).points == box.points).all()


def test_sliding_keeps_sharp_edges_and_corners(box: QuadMesh) -> None:
    before, after = box, slid_tiles(box, everywhere(box))
    moved = np.linalg.norm(after.points - before.points, axis=1)
    corners, edges = before.crease_counts == 3, before.crease_counts == 2
    assert corners.sum() == 8
    assert (moved[corners] == 0).all()
    assert moved[edges].max() > 0.1
    assert np.isclose(np.abs(after.points[edges]), 30, rtol=0, atol=1e-12).sum(axis=1).min() == 2
    np.testing.assert_allclose(np.abs(after.points).max(axis=1), 30, rtol=0, atol=1e-12)
    assert (after.creases == before.creases).all()


def test_points_slide_along_a_crease_towards_the_middle_of_their_neighbours(box: QuadMesh) -> None:
    after = slid_tiles(box, everywhere(box))

    def unevenness(points: np.ndarray) -> float:
        ends = box.tiles.ravel(), np.roll(box.tiles, -1, axis=1).ravel()
        length = np.linalg.norm(points[ends[1]] - points[ends[0]], axis=1)[box.creases]
        return float(length.std())

    assert unevenness(after.points) < unevenness(box.points)


def test_darts_stay_and_other_points_do_not_feel_them() -> None:
    quads = subdivided(sized(torus(around=8, across=4, tube=0.45), size=60), levels=1)
    edge = quads.half_edges.edge
    one = replace(quads, creases=edge == 5)
    plain, found = (slid_tiles(each, everywhere(quads)).points for each in (quads, one))
    darts = one.crease_counts == 1
    assert darts.sum() == 2
    assert (found[darts] == quads.points[darts]).all()
    assert (found[~darts] == plain[~darts]).all()
