"""Values belong to the points of their mesh."""

import numpy as np
import pytest

from fabricate.formats.point_values import PointValues
from fabricate.mesh.cube import cube


def test_scaling_moves_points_and_keeps_values() -> None:
    mesh = cube(divisions=1)
    found = PointValues(mesh, np.arange(8.0)).scaled(3.0)
    assert found.values.tolist() == list(range(8))
    assert (found.mesh.points == 3.0 * mesh.points).all()


def test_there_is_one_value_for_each_point() -> None:
    with pytest.raises(ValueError, match="expected an array of shape"):
        PointValues(cube(divisions=1), np.zeros(7))
