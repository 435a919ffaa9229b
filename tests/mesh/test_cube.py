from __future__ import annotations

from itertools import permutations, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shape_oracles import crossings

from fabricate.errors import MeshError
from fabricate.mesh.closed import checked_closed, genus, signed_volume
from fabricate.mesh.cube import cube

divisions = st.integers(1, 9)


@given(divisions=divisions)
def test_counts(divisions: int) -> None:
    mesh = cube(divisions=divisions)
    assert len(mesh.points) == 6 * divisions**2 + 2
    assert mesh.face_sizes.tolist() == [4] * (6 * divisions**2)
    valences, counts = np.unique(np.bincount(mesh.corners), return_counts=True)
    assert counts[valences == 3] == [8]
    assert set(valences.tolist()) <= {3, 4}


@given(divisions=divisions)
def test_cube_is_closed_and_outward(divisions: int) -> None:
    mesh = cube(divisions=divisions)
    assert checked_closed(mesh) is mesh
    assert genus(mesh) == 0
    assert signed_volume(mesh) == pytest.approx(8, rel=1e-12)


@given(divisions=divisions)
def test_no_two_faces_cross(divisions: int) -> None:
    mesh = cube(divisions=divisions)
    assert crossings(mesh) == 0


@given(divisions=divisions)
def test_faces_are_equal_squares(divisions: int) -> None:
    mesh = cube(divisions=divisions)
    a, b, c, d = np.moveaxis(mesh.points[mesh.corners.reshape(-1, 4)], 1, 0)
    np.testing.assert_allclose(a + c, b + d, atol=1e-14)
    np.testing.assert_allclose(np.linalg.norm([b - a, c - b], axis=-1), 2 / divisions, rtol=1e-12)
    np.testing.assert_allclose(np.einsum("ij,ij->i", b - a, c - b), 0, atol=1e-14)


@given(divisions=divisions)
def test_points_have_all_symmetries_of_the_cube_exactly(divisions: int) -> None:
    points = cube(divisions=divisions).points
    known = set(map(tuple, points.tolist()))
    assert np.abs(points).max(axis=1).tolist() == [1.0] * len(points)
    for axes, signs in product(permutations(range(3)), product((-1, 1), repeat=3)):
        assert set(map(tuple, (points[:, axes] * signs).tolist())) == known


@pytest.mark.parametrize("divisions", [0, -1])
def test_fewer_than_one_division_is_an_error(divisions: int) -> None:
    with pytest.raises(MeshError, match=f"divisions must be 1 or more, found {divisions}"):
        cube(divisions=divisions)
