"""Places near tangent planes: corners and edges of a shape hold, planes let slide."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.mesh.cube import cube
from fabricate.prepare.tangent_planes import HOLD, TangentPlanes
from fabricate.prepare.triangle_mesh import fanned

CUBE = fanned(cube(divisions=2))
HALF = float(CUBE.points.max())
AT_EDGES = (np.abs(np.abs(CUBE.points) - HALF) < 1e-9).sum(axis=1)
"""1 within a face, 2 on an edge, 3 at a corner of the cube."""

steps = st.tuples(*[st.floats(-0.1, 0.1)] * 3).map(np.array)


@given(steps)
def test_only_the_part_of_a_step_along_the_surface_remains(step: np.ndarray) -> None:
    every_point = np.arange(len(CUBE.points))[:, None]
    moved = TangentPlanes.of(CUBE).nearest(every_point, CUBE.points + step) - CUBE.points
    on_plane = np.abs(np.abs(CUBE.points) - HALF) < 1e-9
    assert np.allclose(moved[~on_plane], np.broadcast_to(step, moved.shape)[~on_plane])
    # each of up to three planes has a third of the weight or more, which the hold is compared with
    assert (np.abs(moved) <= np.abs(step) * np.where(on_plane, HOLD / (HOLD + 1 / 6), 1) + 1e-12).all()


def test_an_edge_that_ends_at_a_corner_is_drawn_to_the_corner() -> None:
    corner = int(np.argmax(AT_EDGES == 3))
    others = np.flatnonzero(AT_EDGES == 2)
    beside = others[np.argmin(np.linalg.norm(CUBE.points[others] - CUBE.points[corner], axis=1))]
    middle = CUBE.points[[corner, beside]].mean(axis=0)
    place = TangentPlanes.of(CUBE).nearest(np.array([[corner, beside]]), middle[None])[0]
    assert np.linalg.norm(place - CUBE.points[corner]) < 0.4 * np.linalg.norm(middle - CUBE.points[corner])


def test_planes_weigh_as_much_as_their_areas() -> None:
    planes = TangentPlanes.of(CUBE)
    assert np.trace(planes.quadratic, axis1=1, axis2=2).sum() == pytest.approx(3 * 2 * CUBE.area)
