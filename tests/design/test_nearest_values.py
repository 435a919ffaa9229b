"""Values of a mesh, where its surface is nearest."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.design.nearest_values import nearest_values
from fabricate.formats.point_values import PointValues
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import geodesic_sphere

CUBE = cube(divisions=2)


@given(st.tuples(*3 * [st.floats(-3, 3)]), st.integers(0, 2**32 - 1))
def test_a_linear_function_stays_itself(slope: tuple[float, float, float], seed: int) -> None:
    mesh = geodesic_sphere(frequency=3)
    weights = np.random.default_rng(seed).dirichlet(np.ones(3), size=50)
    triangles = mesh.points[mesh.corners.reshape(-1, 3)[:50]]
    places = np.einsum("tk,tkj->tj", weights, triangles)
    found = nearest_values(PointValues(mesh, mesh.points @ slope), places)
    assert found == pytest.approx(places @ slope, abs=1e-9)


def test_places_above_the_surface_have_the_value_below_them() -> None:
    values = PointValues(CUBE, CUBE.points[:, 0])
    top = float(CUBE.points[:, 2].max())
    places = np.array([[0.3 * top, 0.1 * top, 1.2 * top], [-0.6 * top, 0.2 * top, 2.0 * top]])
    assert nearest_values(values, places) == pytest.approx(places[:, 0])


def test_at_the_points_the_values_are_their_own() -> None:
    values = np.random.default_rng(1).normal(size=len(CUBE.points))
    assert nearest_values(PointValues(CUBE, values), CUBE.points) == pytest.approx(values)


def test_triangles_without_area_give_the_mean_of_their_corners() -> None:
    mesh = PolygonMesh(np.zeros((3, 3)), np.array([0, 1, 2]), np.array([0, 3]))
    found = nearest_values(PointValues(mesh, np.array([1.0, 2.0, 6.0])), np.ones((2, 3)))
    assert found == pytest.approx(3.0)
