from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shape_oracles import crossings, limit_points

from fabricate.errors import MeshError
from fabricate.mesh.closed import checked_closed, genus, signed_volume
from fabricate.mesh.torus import limit_radius, torus, tube_cage

around = st.integers(3, 40)
across = st.integers(3, 20)
share = st.floats(0.05, 0.98)  # of the thickest tube


def thickest(across: int) -> float:
    """Return the tube radius at which the innermost points of the cage meet on the axis."""
    roll = 2 * np.pi * np.arange(across) / across
    return (2 + np.cos(2 * np.pi / across)) / 3 / -np.cos(roll).min()


@given(around=around, across=across, share=share)
def test_counts(around: int, across: int, share: float) -> None:
    mesh = torus(around=around, across=across, tube=share * thickest(across))
    assert len(mesh.points) == around * across
    assert mesh.face_sizes.tolist() == [4] * (around * across)
    assert np.bincount(mesh.corners).tolist() == [4] * (around * across)


@given(around=around, across=across, share=share)
def test_torus_is_closed_outward_and_has_one_handle(around: int, across: int, share: float) -> None:
    mesh = torus(around=around, across=across, tube=share * thickest(across))
    assert checked_closed(mesh) is mesh
    assert genus(mesh) == 1
    np.testing.assert_allclose(mesh.points.mean(axis=0), 0, atol=1e-12)


@given(around=around, across=across, share=share)
def test_no_two_faces_cross(around: int, across: int, share: float) -> None:
    mesh = torus(around=around, across=across, tube=share * thickest(across))
    assert crossings(mesh) == 0


@given(around=around, across=across, share=share)
def test_limit_points_lie_on_the_torus(around: int, across: int, share: float) -> None:
    tube = share * thickest(across)
    x, y, z = np.moveaxis(limit_points(torus(around=around, across=across, tube=tube), around=around), -1, 0)
    np.testing.assert_allclose(np.hypot(np.hypot(x, y) - 1, z), tube, rtol=1e-12)


def test_volume_converges_to_that_of_the_torus() -> None:
    sizes = (12, 24, 48)
    volumes = [signed_volume(torus(around=2 * n, across=n, tube=0.4)) for n in sizes]
    errors = np.abs(np.array(volumes) - 2 * np.pi**2 * 0.4**2)
    assert errors[-1] < 0.004 * volumes[-1]
    np.testing.assert_allclose(np.log2(errors[:-1] / errors[1:]), 2, atol=0.1)


@given(
    grid=st.tuples(st.integers(3, 9), st.integers(3, 9)),
    seed=st.integers(0, 2**32 - 1),
)
def test_cage_interpolates_whatever_it_is_given(grid: tuple[int, int], seed: int) -> None:
    wanted = np.random.default_rng(seed).normal(size=(*grid, 3))
    np.testing.assert_allclose(limit_points(tube_cage(wanted), around=grid[0]), wanted, atol=1e-12)


@given(count=st.integers(3, 50))
def test_limit_radius_is_that_of_a_regular_polygon(count: int) -> None:
    corners = np.exp(2j * np.pi * np.arange(count) / count)
    limit = (np.roll(corners, 1) + 4 * corners + np.roll(corners, -1)) / 6
    np.testing.assert_allclose(np.abs(limit), limit_radius(count), rtol=1e-12)


@pytest.mark.parametrize(("around", "across"), [(2, 8), (8, 2), (0, 0)])
def test_fewer_than_three_quads_are_an_error(around: int, across: int) -> None:
    with pytest.raises(MeshError, match=f"must be 3 or more, found {around} and {across}"):
        torus(around=around, across=across, tube=0.3)


@pytest.mark.parametrize("tube", [0.0, -0.1, float("nan"), float("inf"), 1.0, thickest(8)])
def test_tube_out_of_range_is_an_error(tube: float) -> None:
    with pytest.raises(MeshError, match=r"above 0 and below 0\.902 with 8 quads across, found"):
        torus(around=12, across=8, tube=tube)
