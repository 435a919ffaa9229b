from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from creases import creased_quad_meshes, prism, with_random_creases
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import beads, bipyramid, dual, named, octahedron, quad_meshes, seeds
from scipy.interpolate import BSpline
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fabricate.duotone.catmull_clark import catmull_clark, subdivided
from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
from fabricate.formats.reading import read_mesh
from fabricate.mesh.closed import checked_closed
from fabricate.mesh.crease import creased, fanned_corners, polygon_normals
from fabricate.mesh.cube import cube
from fabricate.mesh.half_edges import half_edges
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.mesh.torus import torus
from fabricate.surface.limit import LimitOperator, LimitSurface, Samples, limit_vertices

TILES = {name: subdivided(mesh, levels=1) for name, mesh in named().items()}
TILES |= {f"{count} beads": two_coloured(beads(count)) for count in (2, 4)}
ROUND = {
    "sphere": subdivided(geodesic_sphere(frequency=1), levels=1),
    "octahedron": subdivided(octahedron(), levels=1),
    "bipyramid 5": subdivided(bipyramid(5), levels=1),
    "bipyramid 8": subdivided(bipyramid(8), levels=1),
    "dual of bipyramid 6": subdivided(dual(bipyramid(6)), levels=1),
}
CREASED = {
    f"{name}, {share}": subdivided(with_random_creases(mesh, share=share, seed=3), levels=1)
    for name, mesh in named().items()
    for share in (0.1, 0.4, 0.8)
}
CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def operator_on_all(quads: QuadMesh, uv: np.ndarray) -> LimitOperator:
    """Return the operator for the same parameters on every tile, results tile after tile."""
    rows = np.arange(len(quads.tiles) * len(uv)).reshape(len(quads.tiles), len(uv))
    return LimitSurface.of(quads).operator([Samples(np.arange(len(quads.tiles)), uv, rows)], size=rows.size)


def evaluated(quads: QuadMesh, uv: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return positions and normals at the same parameters on every tile, (t, s, 3) each."""
    operator, control = operator_on_all(quads, uv), LimitSurface.of(quads).control
    shape = (len(quads.tiles), len(uv), 3)
    return operator.positions(control).reshape(shape), operator.normals(control).reshape(shape)


def dyadic(levels: int) -> np.ndarray:
    """Return the parameters of the corners of the 4^levels quads that one tile becomes, in their order."""
    uv = CORNERS[None]
    for _ in range(levels):
        after, before = np.roll(uv, -1, axis=1), np.roll(uv, 1, axis=1)
        centre = np.broadcast_to(uv.mean(axis=1, keepdims=True), uv.shape)
        uv = np.stack([uv, (uv + after) / 2, centre, (uv + before) / 2], axis=2).reshape(-1, 4, 2)
    return uv.reshape(-1, 2)


def subdivided_further(quads: QuadMesh, levels: int) -> QuadMesh:
    for _ in range(levels):
        quads = catmull_clark(quads).mesh
    return quads


def assert_agrees_with_deep_subdivision(quads: QuadMesh, levels: int) -> None:
    deep = subdivided_further(quads, levels)
    wanted = limit_vertices(deep)[deep.tiles].reshape(len(quads.tiles), -1, 3)
    np.testing.assert_allclose(evaluated(quads, dyadic(levels))[0], wanted, atol=1e-12)


@pytest.mark.parametrize("name", TILES)
def test_positions_are_those_of_deep_subdivision(name: str) -> None:
    assert_agrees_with_deep_subdivision(TILES[name], levels=4)


@settings(max_examples=40)
@given(quads=quad_meshes())
def test_positions_are_those_of_deep_subdivision_on_any_mesh(quads: QuadMesh) -> None:
    assert_agrees_with_deep_subdivision(quads, levels=3)


def test_valences_from_two_to_ten_have_been_tried() -> None:
    found = {int(n) for quads in TILES.values() for n in np.bincount(quads.tiles.ravel())}
    assert found >= {2, 3, 4, 5, 6, 8}


@given(quads=quad_meshes())
def test_limit_of_a_vertex_stays_when_the_mesh_is_refined(quads: QuadMesh) -> None:
    finer = limit_vertices(catmull_clark(quads).mesh)[: len(quads.points)]
    np.testing.assert_allclose(limit_vertices(quads), finer, atol=1e-13)


@pytest.mark.parametrize("name", TILES)
def test_plain_subdivision_arrives_there_in_the_end(name: str) -> None:
    count = len(TILES[name].points)
    deep = subdivided_further(TILES[name], 6)
    apart = np.linalg.norm(deep.points[:count] - limit_vertices(TILES[name]), axis=1)
    assert apart.max() < 2e-3


@pytest.mark.parametrize("name", TILES)
def test_plain_subdivision_approaches_with_the_square_of_the_tile_size(name: str) -> None:
    meshes = [subdivided_further(TILES[name], k) for k in range(1, 5)]
    apart = [np.linalg.norm(mesh.points - limit_vertices(mesh), axis=1) for mesh in meshes]
    errors = np.array([found.mean() for found in apart])
    slopes = np.log2(errors[:-1] / errors[1:])
    assert slopes[-1] == pytest.approx(2, abs=0.1)


@pytest.mark.parametrize(("around", "across"), [(8, 4), (6, 10)])
def test_regular_torus_is_a_bicubic_spline(around: int, across: int) -> None:
    quads = two_coloured(torus(around=around, across=across, tube=0.5))
    uv = np.random.default_rng(1).random((20, 2))
    i, j = np.divmod(quads.tiles, across)
    along_u = np.stack([i[:, 1] - i[:, 0], j[:, 1] - j[:, 0]], axis=1)
    along_v = np.stack([i[:, 3] - i[:, 0], j[:, 3] - j[:, 0]], axis=1)
    wrapped = [(step + 1) % np.array([around, across]) - 1 for step in (along_u, along_v)]
    corner = np.stack([i[:, 0], j[:, 0]], axis=1)[:, None]
    x, y = np.moveaxis(corner + uv[:, :1] * wrapped[0][:, None] + uv[:, 1:] * wrapped[1][:, None], 2, 0)

    def weights(t: np.ndarray, count: int) -> np.ndarray:
        basis = BSpline.basis_element(np.arange(-2.0, 3.0), extrapolate=False)
        offset = (t[..., None] - np.arange(count) + count / 2) % count - count / 2
        return np.asarray(np.nan_to_num(basis(offset)))

    grid = quads.points.reshape(around, across, 3)
    wanted = np.einsum("tsi,tsj,ijk->tsk", weights(x, around), weights(y, across), grid)
    np.testing.assert_allclose(evaluated(quads, uv)[0], wanted, atol=1e-13)


def side_parameters(side: int, fractions: np.ndarray) -> np.ndarray:
    begin, end = CORNERS[side], CORNERS[(side + 1) % 4]
    return np.asarray(begin + fractions[:, None] * (end - begin))


@pytest.mark.parametrize("name", TILES)
def test_tiles_meet_without_gap_or_crease(name: str) -> None:
    quads, fractions = TILES[name], np.array([0.0, 0.11, 0.25, 0.5, 0.8])
    uv = np.concatenate([side_parameters(side, fractions) for side in range(4)])
    there = np.concatenate([side_parameters(side, 1 - fractions) for side in range(4)])
    for mine, beyond in zip(evaluated(quads, uv), evaluated(quads, there), strict=True):
        mine, beyond = (values.reshape(len(quads.twins), len(fractions), 3) for values in (mine, beyond))
        np.testing.assert_allclose(mine, beyond[quads.twins], atol=1e-10)


@settings(max_examples=40)
@given(quads=quad_meshes(), uv=st.tuples(st.floats(0.01, 0.99), st.floats(0.01, 0.99)))
def test_normals_are_those_of_finite_differences(quads: QuadMesh, uv: tuple[float, float]) -> None:
    step = 1e-4
    around = np.array(uv) + step * np.array([[1, 0], [-1, 0], [0, 1], [0, -1], [0, 0]])
    positions, normals = evaluated(quads, around)
    u, v = positions[:, 0] - positions[:, 1], positions[:, 2] - positions[:, 3]
    wanted = np.cross(u, v)
    length = np.linalg.norm(wanted, axis=1, keepdims=True)
    sound = length[:, 0] > 0.01 * np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1)
    np.testing.assert_allclose(normals[sound, 4], (wanted / length)[sound], atol=2e-4)


@pytest.mark.parametrize("name", TILES)
def test_normals_run_continuously_into_the_corners(name: str) -> None:
    near = CORNERS + 2.0**-18 * np.array([[0.7, 0.4], [-0.4, 0.7], [-0.7, -0.4], [0.4, -0.7]])
    at, beside = (evaluated(TILES[name], uv)[1] for uv in (CORNERS, near))
    valence = np.bincount(TILES[name].tiles.ravel())[TILES[name].tiles]
    np.testing.assert_allclose(at[valence > 2], beside[valence > 2], atol=5e-3)
    # at valence 2 subdivision has eigenvalues 1/4, 1/4 and -1/4: the surface wobbles about its tangents
    np.testing.assert_allclose(at[valence == 2], beside[valence == 2], atol=0.15)


@pytest.mark.parametrize("name", TILES)
def test_normals_have_length_one(name: str) -> None:
    normals = evaluated(TILES[name], dyadic(2))[1]
    np.testing.assert_allclose(np.linalg.norm(normals, axis=2), 1, rtol=1e-12)


@pytest.mark.parametrize("name", ROUND)
def test_normals_of_a_convex_body_point_outward(name: str) -> None:
    positions, normals = evaluated(ROUND[name], dyadic(2))
    assert (np.einsum("tsk,tsk->ts", positions, normals) > 0).all()


@settings(max_examples=40)
@given(quads=quad_meshes(), seed=seeds)
def test_evaluation_is_linear_and_applies_to_any_attribute(quads: QuadMesh, seed: int) -> None:
    rng = np.random.default_rng(seed)
    operator = operator_on_all(quads, rng.random((5, 2)))
    refine = catmull_clark(quads).matrix
    colours = rng.random((len(quads.points), 4))
    found = operator.positions(refine @ colours)
    assert found.shape == (operator.size, 4)
    assert found.min() > -1e-12
    assert found.max() < 1 + 1e-12
    coloured_space = replace(quads, points=colours[:, :3])
    control = LimitSurface.of(coloured_space).control
    np.testing.assert_allclose(operator.positions(control), found[:, :3], atol=1e-13)
    linear, shift = rng.normal(size=(4, 2)), rng.normal(size=2)
    mapped = operator.positions(refine @ (colours @ linear + shift))
    np.testing.assert_allclose(mapped, found @ linear + shift, atol=1e-12)


def test_results_go_to_the_rows_asked_for() -> None:
    quads = TILES["cube"]
    tiles, uv = np.array([3, 20]), np.array([[0.2, 0.3], [0.9, 0.1], [0.5, 0.5]])
    rows = np.array([[7, 0, 4], [1, 6, 2]])
    surface = LimitSurface.of(quads)
    found = surface.operator([Samples(tiles, uv, rows)], size=9).positions(surface.control)
    np.testing.assert_allclose(found[rows], evaluated(quads, uv)[0][tiles], atol=1e-15)
    assert (found[[3, 5, 8]] == 0).all()


@pytest.mark.parametrize("name", TILES)
def test_corners_of_tiles_are_limit_vertices(name: str) -> None:
    wanted = limit_vertices(TILES[name])[TILES[name].tiles]
    np.testing.assert_allclose(evaluated(TILES[name], CORNERS)[0], wanted, atol=1e-13)


@pytest.mark.parametrize("name", CREASED)
def test_with_creases_positions_are_those_of_deep_subdivision(name: str) -> None:
    assert_agrees_with_deep_subdivision(CREASED[name], levels=3)


@settings(max_examples=40)
@given(quads=creased_quad_meshes())
def test_with_creases_on_any_sides_positions_are_those_of_deep_subdivision(quads: QuadMesh) -> None:
    assert_agrees_with_deep_subdivision(quads, levels=3)


def test_darts_creases_and_corners_have_been_tried() -> None:
    kinds = {
        (int(n), int(min(k, 3)))
        for quads in CREASED.values()
        for n, k in zip(np.bincount(quads.tiles.ravel()), quads.crease_counts, strict=True)
    }
    assert kinds >= {(n, k) for n in (3, 4, 6) for k in (0, 1, 2, 3)}


@pytest.mark.parametrize("name", CREASED)
def test_with_creases_plain_subdivision_arrives_at_the_limit(name: str) -> None:
    quads = CREASED[name]
    limit, count, kind = limit_vertices(quads), len(quads.points), quads.crease_counts
    apart = []
    for levels in (3, 5):
        deep = subdivided_further(quads, levels).points[:count]
        apart.append(np.linalg.norm(deep - limit, axis=1))
    assert (apart[1][kind > 2] == 0).all()
    # a quarter each time on creases; darts and valences far from 4 have larger eigenvalues
    np.testing.assert_allclose(apart[1][kind == 2], apart[0][kind == 2] / 16, rtol=1e-3, atol=1e-14)
    for other in (kind == 0, kind == 1):
        assert apart[1][other].max(initial=0) <= 0.5 * apart[0][other].max(initial=0)


@settings(max_examples=40)
@given(quads=creased_quad_meshes())
def test_with_creases_the_limit_of_a_vertex_stays_when_the_mesh_is_refined(quads: QuadMesh) -> None:
    finer = limit_vertices(catmull_clark(quads).mesh)[: len(quads.points)]
    np.testing.assert_allclose(limit_vertices(quads), finer, atol=1e-12)


@pytest.mark.parametrize("name", CREASED)
def test_with_creases_tiles_meet_without_gap(name: str) -> None:
    quads, fractions = CREASED[name], np.array([0.0, 0.11, 0.25, 0.5, 0.8])
    uv = np.concatenate([side_parameters(side, fractions) for side in range(4)])
    there = np.concatenate([side_parameters(side, 1 - fractions) for side in range(4)])
    (mine, own_normals), (beyond, their_normals) = evaluated(quads, uv), evaluated(quads, there)
    mine, beyond = (values.reshape(len(quads.twins), len(fractions), 3) for values in (mine, beyond))
    np.testing.assert_allclose(mine, beyond[quads.twins], atol=1e-10)
    own, their = (v.reshape(len(quads.twins), len(fractions), 3) for v in (own_normals, their_normals))
    soft = ~quads.creases
    np.testing.assert_allclose(own[soft, 1:], their[quads.twins][soft, 1:], atol=1e-9)
    assert np.abs(own[~soft, 3] - their[quads.twins][~soft, 3]).max() > 0.1


@pytest.mark.parametrize("divisions", [1, 2, 3])
@pytest.mark.parametrize("levels", [1, 2])
def test_a_cube_with_sharp_edges_is_the_exact_cube(divisions: int, levels: int) -> None:
    quads = subdivided(creased(cube(divisions=divisions), angle=40.0), levels=levels)
    uv = np.concatenate([dyadic(2), np.random.default_rng(1).random((20, 2))])
    positions, normals = evaluated(quads, uv)
    np.testing.assert_allclose(np.abs(positions).max(axis=2), 1, atol=1e-12)
    np.testing.assert_allclose(np.sort(np.abs(normals), axis=2), np.broadcast_to([0, 0, 1], normals.shape), atol=1e-12)
    assert np.isclose(np.abs(positions), 1, atol=1e-12).all(axis=2).sum() == 24  # three tiles at each corner


@pytest.mark.parametrize("name", named())
def test_where_only_sharp_edges_are_the_limit_goes_through_all_points_and_along_all_edges(name: str) -> None:
    mesh = with_random_creases(named()[name], share=1.0, seed=1)
    quads = subdivided(mesh, levels=1)
    corner = np.bincount(mesh.corners) > 2
    halves = evaluated(quads, side_parameters(0, np.linspace(0, 1, 6)))[0]
    begins, ends = mesh.points[mesh.corners], mesh.points[mesh.corners[mesh.next_corner]]
    both = corner[mesh.corners] & corner[mesh.corners[mesh.next_corner]]
    np.testing.assert_array_equal(halves[both, 0], begins[both])
    way = (ends - begins)[both, None] / np.linalg.norm((ends - begins)[both, None], axis=2, keepdims=True)
    np.testing.assert_allclose(np.cross(halves[both] - begins[both, None], way), 0, atol=1e-13)


@pytest.mark.parametrize("sides", [5, 12])
def test_creased_rim_of_a_prism_is_the_cubic_spline_of_its_points(sides: int) -> None:
    mesh = prism(sides, height=1.6)
    quads = subdivided(mesh, levels=1)
    rim = mesh.points[sides:]
    spline = BSpline(np.arange(-3.0, sides + 4), np.concatenate([rim, rim[:3]]), 3)
    # point k of the ring has its weight's middle at k - 1
    t = np.arange(0, sides, 1 / 8)
    wanted = np.asarray(spline((t - 1) % sides))
    upper = np.flatnonzero(quads.creases & (quads.points[quads.tiles.ravel(), 2] > 0))
    tiles, side = np.divmod(upper, 4)
    fractions = np.arange(0, 1, 0.25)
    found = np.concatenate(
        [evaluated(quads, side_parameters(k, fractions))[0][tiles[side == k]].reshape(-1, 3) for k in range(4)]
    )
    distance = np.linalg.norm(found[:, None] - wanted, axis=2).min(axis=1)
    assert len(found) == 2 * 4 * 2 * sides
    assert distance.max() < 1e-13


def smooth_patches(mesh: PolygonMesh) -> np.ndarray:
    """Return for each face the number of its patch: faces joined across edges that are no creases."""
    connectivity = half_edges(mesh)
    soft = ~mesh.creases
    count = len(mesh.offsets) - 1
    links = (np.ones(soft.sum()), (connectivity.face[soft], connectivity.face[connectivity.twin[soft]]))
    return np.asarray(connected_components(coo_array(links, shape=(count, count)), directed=False)[1])


@pytest.mark.skipif("FABRICATE_CORPUS" not in os.environ, reason="FABRICATE_CORPUS names no folder of meshes")
def test_flat_faces_of_a_part_from_a_cad_program_stay_flat_and_its_edges_straight() -> None:
    path = Path(os.environ["FABRICATE_CORPUS"]) / "good" / "box_component_g6.ply"
    mesh = fanned_corners(creased(checked_closed(read_mesh(path)), angle=40.0))
    quads, size = subdivided(mesh, levels=1), np.ptp(mesh.points)
    positions = evaluated(quads, dyadic(2))[0]
    patch, normals = smooth_patches(mesh), polygon_normals(mesh)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    flat = 0
    for number in range(patch.max() + 1):
        faces = np.flatnonzero(patch == number)
        own = np.isin(mesh.face_of_corner, faces)
        if (normals[faces] @ normals[faces[0]]).min() > np.cos(1e-3):
            flat += 1
            begin = mesh.points[mesh.corners[own][0]]
            for points in (positions[own].reshape(-1, 3), mesh.points[mesh.corners[own]]):
                assert np.abs((points - begin) @ normals[faces].mean(axis=0)).max() < 1e-5 * size
    assert flat > 50
    everywhere = positions.reshape(-1, 3)
    np.testing.assert_allclose(everywhere.min(axis=0), mesh.points.min(axis=0), atol=1e-12 * size)
    np.testing.assert_allclose(everywhere.max(axis=0), mesh.points.max(axis=0), atol=1e-12 * size)
