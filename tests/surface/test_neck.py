from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from crowding import roomy_torus
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist
from truchet import quasi_trees

from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.mesh.cube import cube
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.surface.cut import CutSurface, cut
from fabricate.surface.limit import LimitSurface
from fabricate.surface.neck import DEEPEST, NeckGauge, band_widths, coarse_necks, tile_areas, tile_necks
from fabricate.surface.sizing import sized, tile_sides, tiled

SIDE = 4.0
CUBE = two_coloured(cube(divisions=10).scaled(5 * SIDE))


def cut_up(duotone: Duotone, arc: float, resolution: int) -> CutSurface:
    return cut(duotone, LimitSurface.of(duotone.quads), rings=(arc,), resolution=resolution)


def flat_squares(quads: QuadMesh) -> np.ndarray:
    """Return the tiles of the cube that are two tiles or more away from its edges."""
    reach = np.sort(np.abs(quads.points[quads.tiles]).max(axis=1), axis=1)
    return np.flatnonzero(reach[:, 1] < 3.5 * SIDE)


@settings(max_examples=20)
@given(arc=st.floats(0.3, 0.7), seed=st.integers(0, 99), half=st.integers(1, 6))
def test_necks_of_flat_squares_follow_the_formula(arc: float, seed: int, half: int) -> None:
    duotone = random_duotone(CUBE, seed=seed)
    necks, _ = tile_necks(cut_up(duotone, arc, 2 * half))
    radius = np.where(duotone.joined, 1 - arc, arc)
    flat = flat_squares(CUBE)
    assert len(flat) == 6 * 36
    np.testing.assert_allclose(necks[flat], ((np.sqrt(2) - 2 * radius) * SIDE)[flat], atol=1e-12)


def test_odd_resolutions_miss_the_narrowest_place_by_little() -> None:
    duotone, exact = random_duotone(CUBE, seed=4), (np.sqrt(2) - 1) * SIDE
    off = [tile_necks(cut_up(duotone, 0.5, n))[0][flat_squares(CUBE)] - exact for n in (3, 5, 9)]
    assert min(necks.min() for necks in off) > 0
    assert (np.max(off, axis=1) < np.array([0.1, 0.04, 0.012]) * SIDE).all()


@settings(max_examples=20)
@given(duotone=quasi_trees(), arc=st.floats(0.3, 0.7), resolution=st.integers(2, 6))
def test_neck_is_the_least_distance_between_all_points_of_the_two_arcs(
    duotone: Duotone, arc: float, resolution: int
) -> None:
    surface = cut_up(duotone, arc, resolution)
    necks, places = tile_necks(surface)
    arcs = surface.points[surface.arcs[0]].reshape(len(duotone.joined), 2, resolution + 1, 3)
    for (first, second), neck, place in zip(arcs, necks, places, strict=True):
        apart = cdist(first, second)
        assert neck == pytest.approx(apart.min(), rel=1e-12)
        middles = (first[:, None] + second)[np.isclose(apart, apart.min(), rtol=1e-9)] / 2
        assert np.linalg.norm(middles - place, axis=1).min() < 1e-12


def test_place_is_in_the_middle_of_a_flat_square() -> None:
    duotone = random_duotone(CUBE, seed=0)
    _, places = tile_necks(cut_up(duotone, 0.6, 8))
    flat = flat_squares(CUBE)
    np.testing.assert_allclose(places[flat], CUBE.points[CUBE.tiles].mean(axis=1)[flat], atol=1e-12)


@settings(max_examples=20)
@given(arc=st.floats(0.3, 0.7))
def test_the_gauge_knows_both_ways_to_join_a_square(arc: float) -> None:
    necks = NeckGauge.of(CUBE, rings=(arc,)).necks(CUBE.points)[flat_squares(CUBE)]
    exact = (np.sqrt(2) - 2 * np.array([1 - arc, arc])) * SIDE
    np.testing.assert_allclose(necks, np.broadcast_to(exact, necks.shape), atol=1e-12)


RINGS = (0.37, 0.46, 0.63)


@pytest.mark.parametrize("rings", [(0.4, 0.6), RINGS, (0.33, 0.4, 0.5)])
def test_bands_of_flat_squares_are_as_wide_as_their_rings_are_apart(rings: tuple[float, ...]) -> None:
    duotone, flat = random_duotone(CUBE, seed=2), flat_squares(CUBE)
    surface = cut(duotone, LimitSurface.of(CUBE), rings=rings, resolution=8)
    found = band_widths(surface)
    for (widths, places), (inner, outer) in zip(found, pairwise(rings), strict=True):
        np.testing.assert_allclose(widths[flat], (outer - inner) * SIDE, rtol=1e-12)
        middle = CUBE.points[CUBE.tiles].mean(axis=1)[flat]
        assert (np.abs(places[flat] - middle).max(axis=1) <= SIDE / 2 + 1e-9).all()
    narrowest = np.where(duotone.joined, 1 - rings[0], rings[-1])
    np.testing.assert_allclose(tile_necks(surface)[0][flat], ((np.sqrt(2) - 2 * narrowest) * SIDE)[flat], atol=1e-12)


def test_a_duotone_has_no_bands() -> None:
    assert band_widths(cut_up(random_duotone(CUBE, seed=2), 0.5, 2)) == ()


def test_the_gauge_counts_bands_that_are_narrower_than_necks() -> None:
    necks = NeckGauge.of(CUBE, rings=RINGS).necks(CUBE.points)[flat_squares(CUBE)]
    np.testing.assert_allclose(necks, (0.46 - 0.37) * SIDE, rtol=1e-9)
    wide = NeckGauge.of(CUBE, rings=(0.35, 0.6)).necks(CUBE.points)[flat_squares(CUBE)]
    exact = np.array([(np.sqrt(2) - 2 * 0.65), (np.sqrt(2) - 2 * 0.6)]) * SIDE
    np.testing.assert_allclose(wide, np.broadcast_to(exact, wide.shape), atol=1e-12)


def test_the_gauge_follows_points_that_move(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fabricate.surface.neck.CHUNK", 100)
    gauge = NeckGauge.of(CUBE, rings=(0.5,))
    np.testing.assert_allclose(gauge.necks(2.0 * CUBE.points), 2.0 * gauge.necks(CUBE.points), rtol=1e-12)
    assert gauge.necks(CUBE.points).shape == (len(CUBE.tiles), 2)


@pytest.mark.parametrize("arc", [0.4, 0.5, 0.6])
def test_necks_measured_quickly_are_those_of_a_fine_cut(arc: float) -> None:
    roomy = roomy_torus()
    fine = tile_necks(cut_up(roomy, arc, 24))[0]
    off = coarse_necks(roomy, rings=(arc,)) - fine
    assert off.min() > -1e-9
    assert (off < 0.03 * tile_sides(roomy.quads).reshape(-1, 4).max(axis=1)).all()


def test_areas_of_tiles_are_those_of_flat_squares_and_add_up() -> None:
    surface = cut_up(random_duotone(CUBE, seed=1), 0.4, 6)
    areas = tile_areas(surface)
    assert areas[flat_squares(CUBE)] == pytest.approx(SIDE**2)
    first, second, third = (surface.points[surface.triangles[:, k]] for k in range(3))
    assert areas.sum() == pytest.approx(
        np.linalg.norm(np.cross(second - first, third - first), axis=1).sum() / 2, rel=0.01
    )


def test_under_a_ball_necks_are_narrower_by_the_share_of_its_radius_that_walls_go_down() -> None:
    quads = tiled(sized(geodesic_sphere(frequency=2), size=40), tile_size=4)
    above = NeckGauge.of(quads, rings=(0.5,)).necks(quads.points)
    below = NeckGauge.of(quads, rings=(0.5,), depth=2.0).necks(quads.points)
    np.testing.assert_allclose(below, 0.9 * above, rtol=0.03)
    deepest = NeckGauge.of(quads, rings=(0.5,), depth=15.0).necks(quads.points)
    np.testing.assert_allclose(deepest, DEEPEST * above)


def test_under_a_hollow_necks_are_no_wider_than_above() -> None:
    quads = tiled(sized(geodesic_sphere(frequency=2), size=40), tile_size=4)
    above = NeckGauge.of(quads, rings=(0.5,)).necks(quads.points)
    np.testing.assert_allclose(NeckGauge.of(quads, rings=(0.5,), depth=-2.0).necks(quads.points), above)
