"""Mitres: under every side of a crease the wall is as thick as asked, and the inner surface does not fold."""

from __future__ import annotations

import igl
import numpy as np
import pytest
from creases import prism
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import HANDLES, bipyramid, named, octahedron, seeds, tetrahedron
from scipy.spatial.transform import Rotation

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.mesh.crease import creased, fanned_corners
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.surface.cut import CutSurface, cut
from fabricate.surface.limit import LimitSurface
from fabricate.surface.mitre import MOST, CreaseSides, Mitred, mitred_normals, ways_out
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.normals import area_vectors, unit


def cut_up(mesh: PolygonMesh, *, levels: int = 2, resolution: int = 4) -> CutSurface:
    duotone = random_duotone(subdivided(mesh, levels=levels), seed=2)
    return cut(duotone, LimitSurface.of(duotone.quads), rings=(0.5,), resolution=resolution)


def sharp(mesh: PolygonMesh, *, angle: float = 40.0) -> PolygonMesh:
    return fanned_corners(creased(mesh, angle=angle))


def ways(surface: CutSurface, depth: float) -> np.ndarray:
    mitred = Mitred(surface.normals, surface.mitre, surface.along)
    return ways_out(surface.points, surface.triangles, mitred, depth=depth)


CUBE = cut_up(sharp(cube(divisions=1).scaled(30)))
BODIES = {
    "cube": (CUBE, 2.0),
    "tetrahedron": (cut_up(sharp(tetrahedron().scaled(40))), 2.0),
    "octahedron": (cut_up(sharp(octahedron().scaled(40))), 2.0),
    "bipyramid": (cut_up(sharp(bipyramid(5).scaled(40))), 2.0),
    "double torus": (cut_up(sharp(HANDLES["double torus"][0].scaled(25))), 2.0),
    "polyhedral torus": (cut_up(sharp(HANDLES["even torus"][0].scaled(40), angle=0.0)), 2.0),
}


def sides_at_one_point(normals: np.ndarray) -> CreaseSides:
    return CreaseSides(np.zeros(len(normals), dtype=np.int64), normals)


def mitred_at_one_point(normals: np.ndarray) -> Mitred:
    return mitred_normals(np.array([[0.0, 0.0, 1.0]]), sides_at_one_point(normals))


def random_directions(count: int, seed: int) -> np.ndarray:
    found = np.random.default_rng(seed).normal(size=(count, 3))
    return np.asarray(found / np.linalg.norm(found, axis=1, keepdims=True))


def two_sides(degrees: float, seed: int) -> np.ndarray:
    half = np.radians(degrees) / 2
    both = np.array([[np.cos(half), np.sin(half), 0], [np.cos(half), -np.sin(half), 0]])
    return np.asarray(both @ Rotation.random(random_state=np.random.RandomState(seed)).as_matrix())


@given(degrees=st.floats(2.0, 150.0), seed=seeds)
def test_two_sides_are_mitred_along_their_bisector(degrees: float, seed: int) -> None:
    normals = two_sides(degrees, seed)
    found = mitred_at_one_point(normals)
    np.testing.assert_allclose(normals @ (found.mitre[0] * found.normals[0]), 1, atol=1e-9)
    assert found.mitre[0] == pytest.approx(1 / np.cos(np.radians(degrees / 2)))
    np.testing.assert_allclose(normals @ found.along[0], 0, atol=1e-9)
    assert np.linalg.norm(found.along[0]) == pytest.approx(1)


@given(seed=seeds)
def test_three_sides_have_one_mitre_and_no_tangent(seed: int) -> None:
    axis = random_directions(1, seed)
    normals = random_directions(3, seed + 1) * 0.4 + axis
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    found = mitred_at_one_point(normals)
    if abs(np.linalg.det(normals)) > 0.05:
        np.testing.assert_allclose(normals @ (found.mitre[0] * found.normals[0]), 1, atol=1e-6)
        assert not found.along.any()


@given(count=st.integers(4, 9), seed=seeds)
def test_of_many_sides_the_one_that_needs_most_decides(count: int, seed: int) -> None:
    normals = random_directions(count, seed) * 0.6 + random_directions(1, seed + 1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    found = mitred_at_one_point(normals)
    assert 1.0 <= found.mitre[0] <= MOST
    if found.mitre[0] < MOST:
        depth = normals @ (found.mitre[0] * found.normals[0])
        assert depth.min() == pytest.approx(1)


@given(degrees=st.floats(151.2, 178.0), seed=seeds)
def test_a_razor_edge_gets_the_largest_mitre(degrees: float, seed: int) -> None:
    found = mitred_at_one_point(two_sides(degrees, seed))
    assert found.mitre[0] == MOST
    assert np.linalg.norm(found.normals[0]) == pytest.approx(1)


@given(degrees=st.floats(0.0, 1.0), count=st.integers(1, 4), seed=seeds)
def test_sides_in_one_plane_are_no_crease(degrees: float, count: int, seed: int) -> None:
    found = mitred_at_one_point(np.tile(two_sides(degrees, seed), (count, 1)))
    assert found.mitre[0] == 1.0
    assert found.normals[0].tolist() == [0.0, 0.0, 1.0]
    assert not found.along.any()


def test_sides_that_lie_on_each_other_have_no_mitre() -> None:
    found = mitred_at_one_point(np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]]))
    assert found.mitre[0] == 1.0
    assert found.normals[0].tolist() == [0.0, 0.0, 1.0]


@given(seed=seeds, tiles=st.integers(1, 6))
def test_it_does_not_matter_into_how_many_tiles_a_side_is_divided(seed: int, tiles: int) -> None:
    normals = random_directions(3, seed) * 0.4 + random_directions(1, seed + 1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    if abs(np.linalg.det(normals)) > 0.1:
        once, often = (mitred_at_one_point(np.concatenate([np.tile(normals[:1], (k, 1)), normals])) for k in (0, tiles))
        np.testing.assert_allclose(once.normals * once.mitre, often.normals * often.mitre, atol=1e-6)


def test_mitres_of_a_cube() -> None:
    on = np.isclose(np.abs(CUBE.points), 30, atol=1e-9).sum(axis=1)
    np.testing.assert_allclose(np.square(CUBE.mitre), on, rtol=1e-12)
    assert (CUBE.mitre[on == 1] == 1.0).all()
    assert (on == 3).sum() == 8
    np.testing.assert_allclose(np.linalg.norm(CUBE.normals, axis=1), 1, rtol=1e-12)
    np.testing.assert_allclose(np.abs(CUBE.along).max(axis=1), on == 2, atol=1e-12)


@pytest.mark.parametrize("sides", [9, 16])
def test_mitres_round_the_rims_of_a_prism(sides: int) -> None:
    surface = cut_up(prism(sides, height=1.6), resolution=6)
    rim = np.isclose(np.abs(surface.points[:, 2]), 0.8, atol=1e-12) & (surface.mitre > 1.0)
    assert (surface.mitre > 1.0).sum() == rim.sum()
    np.testing.assert_allclose(surface.mitre[rim], np.sqrt(2), atol=1e-3)
    outward = surface.points[rim] * [1, 1, 0]
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    assert (np.einsum("ij,ij->i", outward, surface.normals[rim]) > 0.7).all()
    assert np.abs(surface.along[rim, 2]).max() < 1e-9
    assert np.abs(np.einsum("ij,ij->i", outward, surface.along[rim])).max() < np.pi / sides


@pytest.mark.parametrize("name", named())
def test_surfaces_without_creases_have_no_mitre(name: str) -> None:
    surface = cut_up(named()[name], levels=1)
    assert (surface.mitre == 1.0).all()
    assert not surface.along.any()
    assert (ways(surface, 2.0) == surface.normals).all()


@pytest.mark.parametrize("name", BODIES)
def test_the_wall_of_a_polyhedron_has_one_thickness(name: str) -> None:
    surface, depth = BODIES[name]
    inner = surface.points - depth * ways(surface, depth)
    facets = unit(area_vectors(surface.points, surface.triangles))
    for k in range(3):
        corner = surface.triangles[:, k]
        under = np.einsum("ij,ij->i", surface.points[corner] - inner[corner], facets)
        np.testing.assert_allclose(under, depth, rtol=1e-6)
    middles = inner[surface.triangles].mean(axis=1)
    distance = np.sqrt(igl.point_mesh_squared_distance(middles, surface.points, surface.triangles)[0])
    assert distance.min() > 0.999 * depth


@pytest.mark.parametrize("name", BODIES)
def test_the_inner_surface_does_not_fold(name: str) -> None:
    surface, depth = BODIES[name]
    inner = surface.points - depth * ways(surface, depth)
    areas, outer_areas = (area_vectors(points, surface.triangles) for points in (inner, surface.points))
    assert (np.einsum("ij,ij->i", areas, outer_areas) > 0).all()
    assert len(crossing_triangles(inner, surface.triangles)) == 0


def test_straight_down_from_beside_a_crease_it_would_fold() -> None:
    inner = CUBE.points - 2.0 * CUBE.mitre[:, None] * CUBE.normals
    assert len(crossing_triangles(inner, CUBE.triangles)) > 0


def test_steps_aside_fade_away_from_the_creases() -> None:
    aside = np.linalg.norm(ways(CUBE, 0.5) - CUBE.mitre[:, None] * CUBE.normals, axis=1)
    away = np.sort(30 - np.abs(CUBE.points), axis=1)[:, 1]  # from the nearest edge
    assert aside[away > 20].max() < 0.1
    assert aside[(away > 1e-9) & (away < 1)].min() > 0.5
    assert aside[CUBE.mitre > 1.6].max() == 0.0


@settings(max_examples=10)
@given(depth=st.floats(0.1, 4.0), seed=seeds)
def test_ways_turn_with_the_surface(depth: float, seed: int) -> None:
    turn = Rotation.random(random_state=np.random.RandomState(seed)).as_matrix()
    mitred = Mitred(CUBE.normals @ turn, CUBE.mitre, CUBE.along @ turn)
    turned = ways_out(CUBE.points @ turn, CUBE.triangles, mitred, depth=depth)
    np.testing.assert_allclose(turned, ways(CUBE, depth) @ turn, atol=1e-6)


def test_the_same_surface_gives_the_same_bytes() -> None:
    assert ways(CUBE, 2.0).tobytes() == ways(CUBE, 2.0).tobytes()
