"""The inner surface: depth where the body is thin, and points that move where they should."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
import pytest
from scipy.sparse import csr_array

from fabricate.arrays import Floats, Mask
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.cube import cube
from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus
from fabricate.solid.inset import (
    DEPTH_SLOPE,
    capped_depth,
    downward,
    relaxed,
    spread,
    ways_in,
)
from fabricate.solid.settling import fitted_cut
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled
from fabricate.triangles.adjacency import grown, neighbour_means
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.normals import area_vectors
from fabricate.triangles.search_tree import SearchTree

DEPTH = 2.0

Mending: TypeAlias = Callable[[CutSurface, Floats, Mask, csr_array], Floats]


@pytest.fixture(scope="module")
def surface() -> CutSurface:
    quads = tiled(sized(torus(around=8, across=4, tube=0.45), size=60), tile_size=12)
    return fitted_cut(grown_duotone(quads, tree="random", seed=3), tolerance=0.3)


@pytest.fixture(scope="module")
def ball() -> CutSurface:
    quads = tiled(sized(sphere(faces="triangles", frequency=1), size=40), tile_size=10)
    return fitted_cut(grown_duotone(quads, tree="random", seed=3), tolerance=0.3)


def under(surface: CutSurface) -> np.ndarray:
    return np.asarray(surface.points - DEPTH * surface.normals)


def one(surface: CutSurface, number: int = 40) -> np.ndarray:
    return np.isin(np.arange(len(surface.points)), [number])


def test_a_thick_body_gets_the_whole_thickness(ball: CutSurface) -> None:
    assert (capped_depth(ball, -ball.normals, thickness=DEPTH, between=0.3) == DEPTH).all()


def test_two_walls_and_what_is_between_them_fit_into_a_thin_body(ball: CutSurface) -> None:
    depth = capped_depth(ball, -ball.normals, thickness=30.0, between=4.0)
    radius = np.linalg.norm(ball.points, axis=1)
    assert depth.max() <= radius.max() - 4.0 / 2
    assert depth.min() >= 0.9 * radius.min() - 4.0 / 2


def test_depth_changes_gently(surface: CutSurface) -> None:
    depth = capped_depth(surface, -surface.normals, thickness=12.0, between=1.0)
    assert np.ptp(depth) > 0.1
    for k in range(3):
        begin, end = surface.triangles[:, k], surface.triangles[:, k - 1]
        length = np.linalg.norm(surface.points[begin] - surface.points[end], axis=1)
        assert (np.abs(depth[begin] - depth[end]) <= DEPTH_SLOPE * length + 1e-9).all()


def test_even_a_hopeless_body_keeps_a_tenth(ball: CutSurface) -> None:
    assert capped_depth(ball, -ball.normals, thickness=DEPTH, between=100.0) == pytest.approx(
        np.full(len(ball.points), 0.1 * DEPTH)
    )


def test_sliding_keeps_every_depth_and_all_that_is_far(surface: CutSurface) -> None:
    means = neighbour_means(surface.triangles, count=len(surface.points))
    inner, faulty = under(surface), one(surface)
    moved = spread(surface, inner, faulty, means) - inner
    assert moved[faulty].any()
    assert np.einsum("ij,ij->i", moved, surface.normals) == pytest.approx(0.0, abs=1e-9)
    assert not moved[~grown(faulty, means, 40)].any()


def test_relaxing_flattens_a_spike_and_leaves_what_is_far(surface: CutSurface) -> None:
    means = neighbour_means(surface.triangles, count=len(surface.points))
    inner, faulty = under(surface), one(surface)
    spiky = inner + 1.5 * faulty[:, None] * surface.normals
    flat = relaxed(surface, spiky, faulty, means)
    assert np.linalg.norm((flat - inner)[faulty]) < 0.5 * np.linalg.norm((spiky - inner)[faulty])
    assert (flat == spiky)[~grown(faulty, means, 3)].all()


@pytest.mark.parametrize("kind", [spread, relaxed])
def test_nothing_faulty_moves_nothing(surface: CutSurface, kind: Mending) -> None:
    means = neighbour_means(surface.triangles, count=len(surface.points))
    inner, none = under(surface), np.zeros(len(surface.points), dtype=bool)
    assert (kind(surface, inner, none, means) == inner).all()


def test_ways_into_a_ball_are_straight_and_as_long_as_the_depth(ball: CutSurface) -> None:
    assert ways_in(ball, thickness=DEPTH) == pytest.approx(-ball.normals, abs=0.03)


@pytest.fixture(scope="module")
def ridged() -> CutSurface:
    """A box whose edges are rounded with a radius of about half of the depth."""
    quads = tiled(sized(cube(divisions=20), size=40), tile_size=2)
    return fitted_cut(grown_duotone(quads, tree="random", seed=3), tolerance=0.05)


def flips(surface: CutSurface, inner: np.ndarray) -> int:
    before, after = (area_vectors(points, surface.triangles) for points in (surface.points, inner))
    return int((np.einsum("ij,ij->i", before, after) < 0).sum())


def test_straight_down_a_narrow_ridge_folds_and_the_ways_in_do_not(ridged: CutSurface) -> None:
    assert flips(ridged, ridged.points - DEPTH * ridged.normals) > 100
    inner = ridged.points + DEPTH * ways_in(ridged, thickness=DEPTH)
    assert flips(ridged, inner) == 0
    assert not len(crossing_triangles(inner, ridged.triangles))


def test_beside_a_ridge_the_wall_is_nearly_as_thick_as_asked(ridged: CutSurface) -> None:
    inner = ridged.points + DEPTH * ways_in(ridged, thickness=DEPTH)
    distance = SearchTree.of(ridged.points, ridged.triangles).nearest(inner).distance
    assert distance.min() > 0.65 * DEPTH
    assert (distance < 0.8 * DEPTH).mean() < 0.03


def test_the_way_down_is_against_the_normal_where_the_surface_is_smooth(surface: CutSurface) -> None:
    assert downward(surface.points, surface.triangles, -1.5 * surface.normals) == pytest.approx(-1.5 * surface.normals)


def test_the_way_down_goes_in_through_triangles_that_the_normal_leaves(surface: CutSurface) -> None:
    tilted, number = surface.normals.copy(), one(surface).argmax()
    tangent = surface.points[surface.triangles[(surface.triangles == number).any(axis=1)][0]].mean(axis=0)
    tangent = tangent - surface.points[number]
    tilted[number] = 0.1 * surface.normals[number] + tangent / np.linalg.norm(tangent)
    tilted[number] /= np.linalg.norm(tilted[number])
    way = downward(surface.points, surface.triangles, -tilted)
    facets = surface.points[surface.triangles[(surface.triangles == number).any(axis=1)]]
    normals = np.cross(facets[:, 1] - facets[:, 0], facets[:, 2] - facets[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    assert (normals @ tilted[number]).min() < 0.1
    assert (normals @ way[number]).max() <= -0.29
