"""Clearance: copies of the curve move along rays, by the right amount, and never out of them."""

from __future__ import annotations

import numpy as np
import pytest
from crowding import crowded_torus
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import seeds

from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.errors import SolidError
from fabricate.mesh.torus import torus
from fabricate.solid.clearance import (
    FARTHEST,
    RaySides,
    Shares,
    along,
    check_necks,
    clearance_shares,
    moved_copies,
    ray_sides,
    too_near,
)
from fabricate.solid.settling import fitted_cut
from fabricate.surface.cut import CutSurface, cut
from fabricate.surface.limit import LimitSurface
from fabricate.surface.neck import tile_areas, tile_necks
from fabricate.surface.sizing import sized, tiled


@pytest.fixture(scope="module")
def surface() -> CutSurface:
    quads = tiled(sized(torus(around=8, across=4, tube=0.45), size=60), tile_size=12)
    return fitted_cut(grown_duotone(quads, tree="random", seed=3), tolerance=0.4)


def sides_of(surface: CutSurface) -> RaySides:
    return ray_sides(surface, surface.points)[0]


def test_many_small_tiles_do_not_refuse_a_body_but_narrow_necks_everywhere_do() -> None:
    duotone = crowded_torus()
    cut_up = cut(duotone, LimitSurface.of(duotone.quads), rings=(0.5,), resolution=4)
    necks, areas = tile_necks(cut_up)[0], tile_areas(cut_up)
    order = np.argsort(necks)
    share = np.cumsum(areas[order]) / areas.sum()
    just_fits = float(necks[order][np.searchsorted(share, 0.25)])
    assert just_fits > np.quantile(necks, 0.25)
    check_necks(cut_up, clearance=0.99 * just_fits)
    with pytest.raises(SolidError, match="leaves nothing of the necks on a quarter of the surface"):
        check_necks(cut_up, clearance=1.01 * just_fits)


@given(seed=seeds, steps=st.integers(1, 6), count=st.integers(1, 5))
@settings(max_examples=50)
def test_along_is_interpolation_by_length(seed: int, steps: int, count: int) -> None:
    random = np.random.default_rng(seed)
    side, shares = random.normal(size=(count, steps + 1, 3)), random.random((count, 4))
    found = along(side, shares)
    for ray, share, points in zip(side, shares, found, strict=True):
        reached = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(ray, axis=0), axis=1))])
        oracle = np.stack([np.interp(share * reached[-1], reached, axis) for axis in ray.T], axis=1)
        assert points == pytest.approx(oracle, abs=1e-9)


def test_along_begins_and_ends_at_the_ray_s_ends() -> None:
    side = np.random.default_rng(1).normal(size=(7, 4, 3))
    ends = along(side, np.tile([0.0, 1.0], (7, 1)))
    assert (ends[:, 0] == side[:, 0]).all()
    assert ends[:, 1] == pytest.approx(side[:, -1])


def test_a_ray_of_no_length_stays_where_it_is() -> None:
    assert (along(np.ones((1, 3, 3)), np.array([[0.0, 0.5, 1.0]])) == 1.0).all()


def test_both_sides_begin_on_the_curve(surface: CutSurface) -> None:
    sides, curve = sides_of(surface), surface.points[surface.curves[0]]
    assert (sides.left[:, 0] == curve).all()
    assert (sides.right[:, 0] == curve).all()


def test_yellow_is_left_of_the_curve(surface: CutSurface) -> None:
    sides, curve = sides_of(surface), surface.points[surface.curves[0]]
    left = np.cross(surface.normals[surface.curves[0]], np.roll(curve, -1, axis=0) - curve)
    assert (np.einsum("ij,ij->i", sides.left[:, 1] - curve, left) > 0).all()
    assert (np.einsum("ij,ij->i", sides.right[:, 1] - curve, left) < 0).all()


def shares_of(surface: CutSurface, clearance: float) -> Shares:
    normals = surface.normals[surface.curves[0]]
    wanted = np.full(surface.curves.shape[1], clearance)
    return clearance_shares(sides_of(surface), normals, -normals, clearance=wanted)


@pytest.mark.parametrize("clearance", [0.1, 0.3, 0.6])
def test_copies_are_the_clearance_apart(surface: CutSurface, clearance: float) -> None:
    shares = shares_of(surface, clearance)
    yellow, blue = moved_copies(sides_of(surface), shares, np.arange(surface.curves.shape[1]))
    apart = np.linalg.norm(yellow[:, None] - blue[None], axis=2).min(axis=1)
    assert apart.min() >= 0.97 * clearance
    assert np.median(apart) <= 1.5 * clearance


def test_half_is_given_by_either_side_where_there_is_room(surface: CutSurface) -> None:
    copies = moved_copies(sides_of(surface), shares_of(surface, 0.2), np.arange(surface.curves.shape[1]))
    moved = [np.linalg.norm(copy - surface.points[surface.curves[0]], axis=1) for copy in copies]
    assert np.median(moved[0]) == pytest.approx(np.median(moved[1]), rel=0.1)


@pytest.mark.parametrize("clearance", [0.2, 2.0, 50.0])
def test_no_copy_leaves_its_rays(surface: CutSurface, clearance: float) -> None:
    for share in shares_of(surface, clearance):
        assert share.min() >= 0.0
        assert share.max() <= FARTHEST


def test_what_does_not_fit_is_too_near(surface: CutSurface) -> None:
    sides, everywhere = sides_of(surface), np.arange(surface.curves.shape[1])
    shares, least = shares_of(surface, 50.0), np.full(len(everywhere), 50.0)
    assert too_near(moved_copies(sides, shares, everywhere), least, suspects=everywhere).all()


def test_what_fits_is_not(surface: CutSurface) -> None:
    sides, everywhere = sides_of(surface), np.arange(surface.curves.shape[1])
    least = np.full(len(everywhere), 0.99 * 0.3)
    assert not too_near(moved_copies(sides, shares_of(surface, 0.3), everywhere), least, suspects=everywhere).any()


def test_only_suspects_are_looked_at(surface: CutSurface) -> None:
    sides = sides_of(surface)
    still = Shares(*np.zeros((2, surface.curves.shape[1])))
    copies = moved_copies(sides, still, np.arange(surface.curves.shape[1]))
    near = too_near(copies, np.full(surface.curves.shape[1], 0.1), suspects=np.array([5]))
    assert set(np.flatnonzero(near).tolist()) == {5, 6}
