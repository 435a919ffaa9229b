"""Layers and the walls between them: orientation, facing diagonals, and the gap along the curve."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.torus import torus
from fabricate.solid.layers import Layer, flipped, layer, layer_shares, shares_near, wall
from fabricate.solid.settling import fitted_cut
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled

SIDES = 12
TURN = np.arange(SIDES) * (2 * np.pi / SIDES)
RING = np.stack([np.cos(TURN), np.sin(TURN), np.zeros(SIDES)], axis=1)


@pytest.fixture(scope="module")
def surface() -> CutSurface:
    quads = tiled(sized(torus(around=8, across=4, tube=0.45), size=60), tile_size=12)
    return fitted_cut(grown_duotone(quads, tree="random", seed=3), tolerance=0.4)


def test_a_wall_faces_right_of_the_curve() -> None:
    """A curve that runs counter-clockwise, seen from outside, has its right away from the middle."""
    points = np.concatenate([RING - [0, 0, 1], RING])
    corners = points[wall(np.arange(SIDES), 0, SIDES)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    outward = corners.mean(axis=1) * [1, 1, 0]
    assert (np.einsum("ij,ij->i", normals, outward) > 0).all()
    area = np.linalg.norm(normals, axis=1).sum() / 2
    assert area == pytest.approx(SIDES * 2 * np.sin(np.pi / SIDES))


def test_a_wall_ends_at_both_copies_of_the_curve() -> None:
    triangles = wall(np.arange(SIDES), 0, SIDES)
    assert len(triangles) == 2 * SIDES
    directed = {tuple(edge) for k in range(3) for edge in triangles[:, [k, (k + 1) % 3]].tolist()}
    free = {edge for edge in directed if edge[::-1] not in directed}
    ahead = {(k, (k + 1) % SIDES) for k in range(SIDES)}
    assert free == ahead | {(end + SIDES, begin + SIDES) for begin, end in ahead}


def test_facing_walls_are_split_along_the_same_diagonals() -> None:
    first, second = wall(np.arange(SIDES), SIDES, 0), wall(np.arange(SIDES), 3 * SIDES, 2 * SIDES)
    assert (second - first == 2 * SIDES).all()


def test_the_diagonal_is_the_one_of_the_drawing() -> None:
    triangles = np.sort(wall(np.arange(SIDES), 0, SIDES), axis=1)
    assert (np.isin(triangles, [SIDES + 3, 4]).sum(axis=1) == 2).sum() == 2


def test_flipped_twice_is_nothing() -> None:
    triangles = wall(np.arange(SIDES), 0, SIDES)
    assert (flipped(flipped(triangles)) == triangles).all()
    assert (flipped(triangles) != triangles).any()


def apart_by(surface: CutSurface, clearance: np.ndarray) -> Layer:
    shares = layer_shares(surface, surface.points, -surface.normals, clearance=clearance[None])
    return layer(surface, surface.points, shares)


@pytest.mark.parametrize("clearance", [0.2, 0.5])
def test_the_copies_of_a_layer_are_apart_along_the_curve_only(surface: CutSurface, clearance: float) -> None:
    wanted = np.full(surface.curves.shape[1], clearance)
    copies = apart_by(surface, wanted)
    apart = np.linalg.norm(copies.copies[0] - copies.copies[1], axis=1)
    assert apart[surface.curves[0]].min() >= 0.97 * clearance
    assert (apart[surface.rays[:, :, [0, -1]]] <= 1e-9).all()


def test_a_layer_with_hardly_any_clearance_is_its_points(surface: CutSurface) -> None:
    copies = apart_by(surface, np.full(surface.curves.shape[1], 1e-6))
    for copy in copies.copies:
        assert copy == pytest.approx(surface.points, abs=1e-5)


def test_no_triangle_of_a_copy_turns_over(surface: CutSurface) -> None:
    copies = apart_by(surface, np.full(surface.curves.shape[1], 0.5))
    for region, points in enumerate(copies.copies):
        own = surface.regions == region
        corners = points[surface.triangles[own]]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        upward = surface.normals[surface.triangles[own]].mean(axis=1)
        assert (np.einsum("ij,ij->i", normals, upward) > 0).all()


def test_a_layer_close_under_another_moves_like_it(surface: CutSurface) -> None:
    down, clearance = -surface.normals, np.full(surface.curves.shape[1], 0.5)
    levels = surface.points, surface.points + 2.0 * down
    upper, lower = (layer_shares(surface, points, down, clearance=clearance[None])[0] for points in levels)
    assert np.abs(upper.left - lower.left).max() > 0.01
    count = surface.curves.shape[1]
    far, half, close = (shares_near(upper, lower, nearness=np.full(count, value)) for value in (0.0, 0.5, 1.0))
    for own, above, below, between in zip(close, upper, lower, half, strict=True):
        np.testing.assert_allclose(own, above, atol=1e-12)
        np.testing.assert_allclose(between, 0.5 * (above + below), atol=1e-12)
    assert all((own == below).all() for own, below in zip(far, lower, strict=True))
