from __future__ import annotations

import igl
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shape_oracles import crossings, limit_points

from fabricate.errors import MeshError
from fabricate.mesh.closed import checked_closed, genus, signed_volume
from fabricate.mesh.knot import trefoil

around = st.integers(24, 120)
across = st.integers(3, 16)
share = st.floats(0.05, 1)  # of the thickest tube


def thickest(across: int) -> float:
    return 0.85 * (2 + np.cos(2 * np.pi / across)) / 3 * (1 - 1e-12)


def knot(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return points and unit tangents (by central differences) of the torus knot with ring radius 2.2."""
    t = 2 * np.pi * np.arange(count) / count
    distance = 2.2 + np.cos(3 * t)
    points = np.stack([distance * np.cos(2 * t), distance * np.sin(2 * t), np.sin(3 * t)], axis=1)
    tangents = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    return points, tangents / np.linalg.norm(tangents, axis=1, keepdims=True)


@given(around=around, across=across, share=share)
def test_counts(around: int, across: int, share: float) -> None:
    mesh = trefoil(around=around, across=across, tube=share * thickest(across))
    assert len(mesh.points) == around * across
    assert mesh.face_sizes.tolist() == [4] * (around * across)
    assert np.bincount(mesh.corners).tolist() == [4] * (around * across)


@given(around=around, across=across, share=share)
def test_knot_is_closed_outward_and_has_one_handle(around: int, across: int, share: float) -> None:
    mesh = trefoil(around=around, across=across, tube=share * thickest(across))
    assert checked_closed(mesh) is mesh
    assert genus(mesh) == 1


@given(around=around, across=across, share=share)
def test_no_two_faces_cross(around: int, across: int, share: float) -> None:
    mesh = trefoil(around=around, across=across, tube=share * thickest(across))
    assert crossings(mesh) == 0


def test_the_thickest_tube_is_below_the_reach_of_the_curve() -> None:
    # Least radius of the circles through one point of a curve and tangent to it in another:
    # Gonzalez, Maddocks, "Global curvature, thickness, and the ideal shapes of knots", PNAS 96, 1999.
    points, tangents = knot(1200)
    chords = points[:400, None] - points
    squares = np.einsum("ijk,ijk->ij", chords, chords)
    along = np.einsum("ijk,jk->ij", chords, tangents)
    apart = squares > 1e-12
    reach = np.min(squares[apart] / (2 * np.sqrt(squares[apart] - along[apart] ** 2)))
    assert reach == pytest.approx(0.978, abs=0.001)
    with pytest.raises(MeshError):
        trefoil(around=100, across=64, tube=reach)


@settings(max_examples=20)
@given(around=around, across=across, share=share)
def test_limit_points_have_the_tube_radius_as_distance_from_the_curve(around: int, across: int, share: float) -> None:
    tube = share * thickest(across)
    limit = limit_points(trefoil(around=around, across=across, tube=tube), around=around).reshape(-1, 3)
    curve, _ = knot(6000)
    segments = np.stack([np.arange(6000), np.roll(np.arange(6000), -1)], axis=1)
    squared = igl.point_mesh_squared_distance(limit, curve, segments)[0]
    np.testing.assert_allclose(np.sqrt(squared), tube, atol=1e-5)


def test_volume_is_that_of_a_tube() -> None:
    curve, _ = knot(6000)
    length = np.linalg.norm(curve - np.roll(curve, 1, axis=0), axis=1).sum()
    volume = signed_volume(trefoil(around=400, across=64, tube=0.5))
    assert volume == pytest.approx(np.pi * 0.5**2 * length, rel=0.005)


@given(around=around)
def test_rings_follow_each_other_at_equal_distances(around: int) -> None:
    centres = limit_points(trefoil(around=around, across=8, tube=0.5), around=around).mean(axis=1)
    steps = np.linalg.norm(centres - np.roll(centres, 1, axis=0), axis=1)
    assert steps.max() / steps.min() < 1.08


def test_twist_is_even_and_no_more_than_closing_needs() -> None:
    limit = limit_points(trefoil(around=2000, across=8, tube=0.5), around=2000)
    centres = limit.mean(axis=1)
    normals = (limit[:, 0] - centres) / 0.5
    tangents = np.roll(centres, -1, axis=0) - np.roll(centres, 1, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    turned = np.roll(normals, -1, axis=0) - normals
    twist = np.einsum("ij,ij->i", turned, np.cross(tangents, normals))
    assert abs(twist.sum()) <= np.pi
    assert np.ptp(twist) < 0.1 * abs(twist.mean())


@pytest.mark.parametrize(("around", "across"), [(23, 8), (48, 2), (0, 0)])
def test_too_few_quads_are_an_error(around: int, across: int) -> None:
    with pytest.raises(MeshError, match=f"around must be 24 or more.*found {around} and {across}"):
        trefoil(around=around, across=across, tube=0.3)


@pytest.mark.parametrize("tube", [0.0, -0.1, float("nan"), float("inf"), 0.8])
def test_tube_out_of_range_is_an_error(tube: float) -> None:
    with pytest.raises(MeshError, match=r"above 0 and at most 0\.767 with 8 quads across, found"):
        trefoil(around=48, across=8, tube=tube)
