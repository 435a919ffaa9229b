from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import seeds
from scipy.interpolate import BSpline

from fabricate.surface.patch import FAR_POINTS, corner_position, patch_basis

VALENCES = st.integers(2, 12)
# a tile's samples lie some dozen subdivisions from the corner at most
SOMEWHERE = st.one_of(st.sampled_from([0.0, 0.5, 1.0]), st.floats(1e-5, 1))
UV = st.lists(st.tuples(SOMEWHERE, SOMEWHERE), min_size=1, max_size=12).map(np.array)
WITHIN = st.floats(0.01, 0.99)
CREASES = VALENCES.flatmap(lambda n: st.tuples(*[st.booleans()] * n)).filter(any)
INSIDE = st.lists(st.tuples(WITHIN, WITHIN), min_size=1, max_size=12).map(np.array)


def mirrored_numbers(valence: int) -> np.ndarray:
    """Return the control points in the mirror that exchanges u and v."""
    ring = np.arange(valence)
    numbers = np.zeros(2 * valence + 8, dtype=int)
    numbers[1 + 2 * ring] = 1 + 2 * ((1 - ring) % valence)
    numbers[2 + 2 * ring] = 2 + 2 * (-ring % valence)
    numbers[2 * valence + 1 :] = np.arange(2 * valence + 7, 2 * valence, -1)
    return numbers


def spline_weight(offset: int, t: np.ndarray) -> np.ndarray:
    """Return the uniform cubic B-spline centred at `offset`, at t."""
    knots = np.arange(-2, 3) + offset
    return np.nan_to_num(np.asarray(BSpline.basis_element(knots, extrapolate=False)(t)))


def places(valence: int) -> np.ndarray:
    """Return control points in the plane: the regular grid for valence 4, else about what becomes of it."""
    ring = np.arange(valence)
    e = np.exp(2j * np.pi * ring / valence)
    f = e + np.roll(e, -1)
    far = np.array([i * e[0] + j * e[1] for i, j in FAR_POINTS])
    found = np.concatenate([[0], np.stack([e, f], axis=1).ravel(), far])
    return np.stack([found.real, found.imag], axis=1)


@given(valence=VALENCES, uv=UV)
def test_positions_are_means_of_the_control_points(valence: int, uv: np.ndarray) -> None:
    basis = patch_basis(uv, valence=valence)
    assert basis.position.shape == (len(uv), 2 * valence + 8)
    np.testing.assert_allclose(basis.position.sum(axis=1), 1, atol=1e-13)
    assert basis.position.min() > -1e-16


@given(valence=VALENCES, uv=UV)
def test_derivatives_of_a_constant_vanish(valence: int, uv: np.ndarray) -> None:
    basis = patch_basis(uv, valence=valence)
    np.testing.assert_allclose(basis.along_u.sum(axis=1), 0, atol=1e-12)
    np.testing.assert_allclose(basis.along_v.sum(axis=1), 0, atol=1e-12)


@given(valence=VALENCES, uv=UV)
def test_exchanging_u_and_v_is_a_reflection(valence: int, uv: np.ndarray) -> None:
    mirror = mirrored_numbers(valence)
    there, back = patch_basis(uv, valence=valence), patch_basis(uv[:, ::-1].copy(), valence=valence)
    np.testing.assert_allclose(there.position, back.position[:, mirror], atol=1e-14)
    off_corner = uv.max(axis=1) > 0
    np.testing.assert_allclose(there.along_u[off_corner], back.along_v[off_corner][:, mirror], atol=1e-14)


@given(uv=UV)
def test_regular_patch_is_a_bicubic_spline(uv: np.ndarray) -> None:
    basis = patch_basis(uv, valence=4)
    e, f = [(1, 0), (0, 1), (-1, 0), (0, -1)], [(1, 1), (-1, 1), (-1, -1), (1, -1)]
    grid = [(0, 0), *(point for pair in zip(e, f, strict=True) for point in pair), *FAR_POINTS]
    wanted = [spline_weight(i, uv[:, 0]) * spline_weight(j, uv[:, 1]) for i, j in grid]
    np.testing.assert_allclose(basis.position, np.stack(wanted, axis=1), atol=1e-14)


@given(valence=VALENCES, uv=INSIDE)
def test_derivatives_point_where_positions_go(valence: int, uv: np.ndarray) -> None:
    control, step = places(valence), 1e-5
    basis = patch_basis(uv, valence=valence)
    for direction, weights in (([step, 0], basis.along_u), ([0, step], basis.along_v)):
        ahead, behind = (patch_basis(uv + s * np.array(direction), valence=valence) for s in (1, -1))
        wanted = (ahead.position - behind.position) @ control
        found = weights @ control
        wanted /= np.linalg.norm(wanted, axis=1, keepdims=True)
        found /= np.linalg.norm(found, axis=1, keepdims=True)
        np.testing.assert_allclose(found, wanted, atol=1e-6)


@given(valence=st.integers(3, 12), uv=UV)
def test_patch_of_a_flat_fan_keeps_its_orientation(valence: int, uv: np.ndarray) -> None:
    control = places(valence)
    basis = patch_basis(uv, valence=valence)
    (a, b), (c, d) = (basis.along_u @ control).T, (basis.along_v @ control).T
    assert (a * d - b * c > 0).all()


@pytest.mark.parametrize("valence", range(2, 13))
def test_positions_run_continuously_into_the_corner(valence: int) -> None:
    near = 2.0 ** -np.arange(20, 41)[:, None] * np.array([0.7, 1.0])
    found = patch_basis(near, valence=valence).position
    corner = patch_basis(np.zeros((1, 2)), valence=valence).position
    apart = np.abs(found - corner).max(axis=1)
    assert apart[-1] < 1e-6
    assert (np.diff(apart) < 1e-15).all()


@given(valence=VALENCES, uv=UV, seed=seeds)
def test_samples_do_not_feel_each_other(valence: int, uv: np.ndarray, seed: int) -> None:
    order = np.random.default_rng(seed).permutation(len(uv))
    together, apart = patch_basis(uv, valence=valence), patch_basis(uv[order], valence=valence)
    for one, other in zip(together, apart, strict=True):
        np.testing.assert_allclose(one[order], other, atol=1e-15)


@given(valence=VALENCES, uv=UV)
def test_parameters_are_left_alone(valence: int, uv: np.ndarray) -> None:
    before = uv.copy()
    patch_basis(uv, valence=valence)
    assert (uv == before).all()


def creased_places(creases: tuple[bool, ...]) -> np.ndarray:
    """Return control points in space that no symmetry holds together."""
    flat = places(len(creases))
    height = np.random.default_rng(len(creases)).normal(size=len(flat))
    return np.column_stack([flat, 0.2 * height])


@given(creases=CREASES, uv=UV)
def test_with_creases_positions_are_means_too(creases: tuple[bool, ...], uv: np.ndarray) -> None:
    basis = patch_basis(uv, valence=len(creases), creases=creases)
    np.testing.assert_allclose(basis.position.sum(axis=1), 1, atol=1e-13)
    assert basis.position.min() > -1e-15
    np.testing.assert_allclose(basis.along_u.sum(axis=1), 0, atol=1e-12)
    np.testing.assert_allclose(basis.along_v.sum(axis=1), 0, atol=1e-12)


@given(valence=VALENCES, uv=UV)
def test_spokes_that_are_no_creases_change_nothing(valence: int, uv: np.ndarray) -> None:
    plain, told = patch_basis(uv, valence=valence), patch_basis(uv, valence=valence, creases=(False,) * valence)
    for one, other in zip(plain, told, strict=True):
        assert (one == other).all()


@given(creases=CREASES, uv=UV)
def test_exchanging_u_and_v_reflects_the_creases(creases: tuple[bool, ...], uv: np.ndarray) -> None:
    mirror = mirrored_numbers(len(creases))
    mirrored = tuple(np.array(creases)[(1 - np.arange(len(creases))) % len(creases)].tolist())
    there = patch_basis(uv, valence=len(creases), creases=creases)
    back = patch_basis(uv[:, ::-1].copy(), valence=len(creases), creases=mirrored)
    np.testing.assert_allclose(there.position, back.position[:, mirror], atol=1e-14)
    off_corner = uv.max(axis=1) > 0
    np.testing.assert_allclose(there.along_u[off_corner], back.along_v[off_corner][:, mirror], atol=1e-14)


@given(creases=CREASES, uv=INSIDE)
def test_with_creases_derivatives_point_where_positions_go(creases: tuple[bool, ...], uv: np.ndarray) -> None:
    control, step, valence = creased_places(creases), 1e-5, len(creases)
    basis = patch_basis(uv, valence=valence, creases=creases)
    for direction, weights in (([step, 0], basis.along_u), ([0, step], basis.along_v)):
        ahead, behind = (
            patch_basis(uv + s * np.array(direction), valence=valence, creases=creases).position for s in (1, -1)
        )
        wanted, found = (ahead - behind) @ control, weights @ control
        wanted /= np.linalg.norm(wanted, axis=1, keepdims=True)
        found /= np.linalg.norm(found, axis=1, keepdims=True)
        np.testing.assert_allclose(found, wanted, atol=1e-5)


@given(uv=UV, scale=st.floats(0.1, 10))
def test_beside_a_regular_crease_the_other_side_does_not_count(uv: np.ndarray, scale: float) -> None:
    control = creased_places((False,) * 4)
    across = [6, 7, 8, 9]  # the points below the spokes e0 and e2
    moved = control.copy()
    moved[across] += scale
    basis = patch_basis(uv, valence=4, creases=(True, False, True, False))
    np.testing.assert_allclose(basis.position @ control, basis.position @ moved, atol=1e-12)
    np.testing.assert_allclose(basis.along_v @ control, basis.along_v @ moved, atol=1e-11)


@given(creases=CREASES, t=st.floats(1e-4, 1))
def test_a_crease_depends_on_its_own_points_alone(creases: tuple[bool, ...], t: float) -> None:
    basis = patch_basis(np.array([[t, 0.0]]), valence=len(creases), creases=(True, *creases[1:]))
    n, spokes = len(creases), np.flatnonzero((True, *creases[1:]))
    line = {0, 1, 2 * n + 2} | ({1 + 2 * int(spokes[1])} if len(spokes) == 2 else set())
    if len(spokes) > 1:
        assert set(np.flatnonzero(np.abs(basis.position[0]) > 1e-13).tolist()) <= line


@pytest.mark.parametrize(("spokes", "valence"), [((0, 2, 4), 5), ((1, 2, 3), 4), ((0, 1, 2), 3)])
def test_at_a_corner_the_vertex_stays(spokes: tuple[int, ...], valence: int) -> None:
    creases = tuple(k in spokes for k in range(valence))
    position = patch_basis(np.zeros((1, 2)), valence=valence, creases=creases).position[0]
    assert position.tolist() == np.eye(2 * valence + 8)[0].tolist()


@pytest.mark.parametrize("valence", range(2, 13))
def test_on_a_crease_the_vertex_moves_as_on_a_cubic_spline(valence: int) -> None:
    creases = (True, *[False] * (valence - 2), True)
    position = corner_position(creases)
    assert position[0] == pytest.approx(2 / 3)
    assert position[[1, 2 * valence - 1]] == pytest.approx([1 / 6, 1 / 6])
    assert position.sum() == pytest.approx(1)


@pytest.mark.parametrize("valence", range(2, 13))
@pytest.mark.parametrize("spoke", [0, 1, -1])
def test_positions_run_continuously_into_a_dart(valence: int, spoke: int) -> None:
    creases = tuple(k == spoke % valence for k in range(valence))
    near = 2.0 ** -np.arange(20, 41)[:, None] * np.array([0.7, 1.0])
    found = patch_basis(near, valence=valence, creases=creases).position
    corner = patch_basis(np.zeros((1, 2)), valence=valence, creases=creases).position
    apart = np.abs(found - corner).max(axis=1)
    assert apart[-1] < 1e-5
    assert corner.min() > -1e-15


@pytest.mark.parametrize("creases", [(True, True, True), (True, True, True, True, False), (True, True, False, True)])
def test_tangents_of_a_single_tile_at_a_corner_are_its_creases(creases: tuple[bool, ...]) -> None:
    basis = patch_basis(np.zeros((1, 2)), valence=len(creases), creases=creases)
    control = creased_places(creases)
    normal = np.cross(basis.along_u[0] @ control, basis.along_v[0] @ control)
    wanted = np.cross(control[1] - control[0], control[3] - control[0])
    np.testing.assert_allclose(normal / np.linalg.norm(normal), wanted / np.linalg.norm(wanted), atol=1e-12)


@pytest.mark.parametrize(
    "creases",
    [
        (True, False, True, False),
        (False, True, False, True, False),
        (True, False, True, False, False),
        (False, False, True, False, False, True),
        (True, False, False, True),
        (True, False, False),
        (False, True, False),
    ],
)
def test_normals_run_continuously_into_creases_and_darts(creases: tuple[bool, ...]) -> None:
    control = creased_places(creases)
    uv = np.concatenate([np.zeros((1, 2)), 2.0 ** -np.array([[4], [8], [14], [24]]) * np.array([0.9, 0.8])])
    basis = patch_basis(uv, valence=len(creases), creases=creases)
    normals = np.cross(basis.along_u @ control, basis.along_v @ control)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    apart = np.linalg.norm(normals[1:] - normals[0], axis=1)
    assert (np.diff(apart) < 0).all()
    assert apart[-1] < 0.02
