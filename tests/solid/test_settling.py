"""Settling: roomy tilings stay as they are, crowded tiles grow until the clearance fits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.errors import PatternError
from fabricate.mesh.crease import creased
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.torus import torus
from fabricate.solid.settling import _slid, fitted_cut, settled, tight_tiles
from fabricate.surface.cut import cut
from fabricate.surface.limit import LimitSurface
from fabricate.surface.sizing import sized, tiled

CLEARANCE, RESOLUTION = 0.3, 4


@pytest.fixture(scope="module")
def roomy() -> Duotone:
    mesh = sized(torus(around=8, across=4, tube=0.45), size=60)
    return grown_duotone(tiled(mesh, tile_size=12), tree="random", seed=3)


@pytest.fixture(scope="module")
def crowded_box() -> Duotone:
    """A cube with sharp edges, one of whose sides has points pulled together towards an edge."""
    mesh = sized(creased(cube(divisions=6), angle=40.0), size=60)
    points = mesh.points.copy()
    top = np.isclose(points[:, 2], 30)
    points[:, 0] += np.where(top & np.isclose(points[:, 0], 20), 9.4, 0.0)
    near = np.isclose(points[:, 2], 20) & np.isclose(points[:, 0], 30)
    points[:, 2] += np.where(near, 9.4, 0.0)
    return grown_duotone(subdivided(mesh.moved(points), levels=1), tree="random", seed=3)


@pytest.fixture(scope="module")
def crowded() -> Duotone:
    """A torus some of whose cage's points have been pulled together."""
    mesh = sized(torus(around=16, across=8, tube=0.45), size=60)
    grid = np.arange(16 * 8).reshape(16, 8)
    pinched = np.roll(grid, (1, 1), axis=(0, 1))[:3, :3].ravel()
    points = mesh.points.copy()
    middle = points[pinched].mean(axis=0)
    points[pinched] = middle + 0.05 * (points[pinched] - middle)
    return grown_duotone(subdivided(PolygonMesh(points, mesh.corners, mesh.offsets), levels=1), tree="random", seed=3)


@pytest.mark.parametrize("clearance", [0.0, CLEARANCE])
def test_a_roomy_tiling_stays_as_it_is(roomy: Duotone, clearance: float) -> None:
    plain = cut(roomy, LimitSurface.of(roomy.quads), arc=0.5, resolution=RESOLUTION)
    found = settled(roomy, clearance=clearance, arc=0.5, resolution=RESOLUTION)
    assert found.points.tobytes() == plain.points.tobytes()
    assert found.normals.tobytes() == plain.normals.tobytes()


def test_without_clearance_nothing_is_too_crowded(crowded: Duotone) -> None:
    plain = cut(crowded, LimitSurface.of(crowded.quads), arc=0.5, resolution=RESOLUTION)
    found = settled(crowded, clearance=0.0, arc=0.5, resolution=RESOLUTION)
    assert (found.points == plain.points).all()


def test_crowded_tiles_grow_until_the_clearance_fits(crowded: Duotone) -> None:
    before = cut(crowded, LimitSurface.of(crowded.quads), arc=0.5, resolution=RESOLUTION)
    after = settled(crowded, clearance=CLEARANCE, arc=0.5, resolution=RESOLUTION)
    assert tight_tiles(before, clearance=CLEARANCE).any()
    assert not tight_tiles(after, clearance=CLEARANCE).any()


def test_sliding_keeps_sharp_edges_and_corners(crowded_box: Duotone) -> None:
    before, after = crowded_box.quads, _slid(crowded_box.quads, np.ones(len(crowded_box.joined), dtype=bool))
    moved = np.linalg.norm(after.points - before.points, axis=1)
    corners, edges = before.crease_counts == 3, before.crease_counts == 2
    assert corners.sum() == 8
    assert (moved[corners] == 0).all()
    assert moved[edges].max() > 0.1
    assert np.isclose(np.abs(after.points[edges]), 30, rtol=0, atol=1e-12).sum(axis=1).min() == 2
    np.testing.assert_allclose(np.abs(after.points).max(axis=1), 30, rtol=0, atol=1e-12)
    assert (after.creases == before.creases).all()


def test_points_slide_along_a_crease_towards_the_middle_of_their_neighbours(crowded_box: Duotone) -> None:
    quads = crowded_box.quads
    after = _slid(quads, np.ones(len(crowded_box.joined), dtype=bool))

    def unevenness(points: np.ndarray) -> float:
        ends = quads.tiles.ravel(), np.roll(quads.tiles, -1, axis=1).ravel()
        length = np.linalg.norm(points[ends[1]] - points[ends[0]], axis=1)[quads.creases]
        return float(length.std())

    assert unevenness(after.points) < unevenness(quads.points)


def test_darts_stay_and_other_points_do_not_feel_them() -> None:
    quads = subdivided(sized(torus(around=8, across=4, tube=0.45), size=60), levels=1)
    edge = quads.half_edges.edge
    one = replace(quads, creases=edge == 5)
    everywhere = np.ones(len(quads.tiles), dtype=bool)
    plain, found = _slid(quads, everywhere).points, _slid(one, everywhere).points
    darts = one.crease_counts == 1
    assert darts.sum() == 2
    assert (found[darts] == quads.points[darts]).all()
    assert (found[~darts] == plain[~darts]).all()


def test_what_is_far_from_crowded_tiles_stays(crowded: Duotone) -> None:
    before = cut(crowded, LimitSurface.of(crowded.quads), arc=0.5, resolution=RESOLUTION)
    after = settled(crowded, clearance=CLEARANCE, arc=0.5, resolution=RESOLUTION)
    moved = (before.points != after.points).any(axis=1)
    assert 0 < moved.mean() < 0.7
    assert (before.triangles == after.triangles).all()
    assert (before.yellow == after.yellow).all()


def test_tight_tiles_are_where_they_were_planted(crowded: Duotone) -> None:
    surface = cut(crowded, LimitSurface.of(crowded.quads), arc=0.5, resolution=RESOLUTION)
    tight = tight_tiles(surface, clearance=CLEARANCE)
    centres = crowded.quads.points[crowded.quads.tiles].mean(axis=1)
    pinched = centres[tight].mean(axis=0)
    assert np.linalg.norm(centres[tight] - pinched, axis=1).max() < 15.0
    assert len(tight) == len(crowded.joined)


def test_every_tile_is_tight_for_a_huge_clearance(roomy: Duotone) -> None:
    surface = cut(roomy, LimitSurface.of(roomy.quads), arc=0.5, resolution=RESOLUTION)
    assert tight_tiles(surface, clearance=30.0).all()
    assert not tight_tiles(surface, clearance=0.1).any()


def test_a_finer_tolerance_gives_more_triangles_on_the_same_surface(roomy: Duotone) -> None:
    coarse, fine = (fitted_cut(roomy, tolerance=tolerance) for tolerance in (0.4, 0.1))
    assert len(fine.triangles) > len(coarse.triangles)
    corners = len(roomy.quads.points)
    assert fine.points[:corners] == pytest.approx(coarse.points[:corners], abs=1e-9)


@pytest.mark.parametrize("arc", [0.29, 0.71])
def test_arcs_that_would_meet_are_refused(roomy: Duotone, arc: float) -> None:
    with pytest.raises(PatternError, match="arc"):
        fitted_cut(roomy, arc=arc, tolerance=0.4)
