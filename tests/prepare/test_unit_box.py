from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import seeds

from fabricate.prepare.unit_box import UnitBox


@given(seeds, st.floats(-250, 250), st.floats(-3, 3))
def test_the_box_has_diagonal_1_and_all_comes_back(seed: int, size: float, shift: float) -> None:
    rng = np.random.default_rng(seed)
    points = (rng.random((9, 3)) + shift) * 10.0**size
    box = UnitBox.of(points)
    placed = box.placed(points)
    assert np.linalg.norm(np.ptp(placed, axis=0)) == pytest.approx(1)
    assert placed.max(axis=0) + placed.min(axis=0) == pytest.approx(0, abs=1e-9)
    assert box.restored(placed) == pytest.approx(points, rel=1e-9, abs=1e-12 * np.abs(points).max())


@pytest.mark.parametrize("value", [0.0, 3.0])
def test_points_that_all_coincide_are_in_the_middle(value: float) -> None:
    points = np.full((4, 3), value)
    assert (UnitBox.of(points).placed(points) == 0).all()
