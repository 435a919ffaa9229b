from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import beads, bipyramid, dual, named, octahedron, quad_meshes, seeds
from scipy.interpolate import BSpline

from fabricate.duotone.catmull_clark import catmull_clark, subdivided
from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
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
