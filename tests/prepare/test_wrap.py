"""Alpha wrap: whatever the triangles, what comes out is closed, does not cross itself, and contains them."""

from __future__ import annotations

import igl
import numpy as np
import pytest
from breaking import box, triangles
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import seeds

from fabricate.errors import MeshError
from fabricate.mesh.closed import check_closed_manifold, signed_volume
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.components import components
from fabricate.prepare.wrap import finite_triangles, from_triangles, wrapped
from fabricate.triangles.crossing import crossing_triangles

pytest.importorskip("pymeshlab")


def faces_of(mesh: PolygonMesh) -> np.ndarray:
    return np.ascontiguousarray(mesh.corners.reshape(-1, 3))


@settings(max_examples=8)
@given(seeds, st.integers(1, 12), st.sampled_from([1e-200, 1e-9, 1.0, 1e9, 1e100]))
def test_a_soup_is_contained_in_its_wrap(seed: int, count: int, scale: float) -> None:
    soup = np.random.default_rng(seed).normal(size=(3 * count, 3))
    wrap = wrapped(scale * soup, np.arange(3 * count).reshape(-1, 3), alpha=0.1, offset=0.03)
    check_closed_manifold(wrap.moved(wrap.points / scale))
    points = np.ascontiguousarray(wrap.points / scale)
    assert len(crossing_triangles(points, faces_of(wrap))) == 0
    assert igl.winding_number(points, faces_of(wrap), soup) == pytest.approx(1, abs=1e-3)


def test_a_box_grows_by_the_offset() -> None:
    mesh = box(2.0)
    diagonal = 2 * np.sqrt(3)
    wrap = wrapped(mesh.points, triangles(mesh), alpha=0.05, offset=0.01)
    assert wrap.points.max(axis=0) == pytest.approx(1 + 0.01 * diagonal, abs=1e-3)
    assert 8 < signed_volume(wrap) < (2 + 2 * 0.01 * diagonal) ** 3


def test_the_same_triangles_give_the_same_bytes() -> None:
    first, second = (wrapped(box().points, triangles(box()), alpha=0.1, offset=0.02) for _ in range(2))
    assert first.points.tobytes() == second.points.tobytes()
    assert first.corners.tobytes() == second.corners.tobytes()


def test_bodies_far_apart_are_two_components() -> None:
    points = np.concatenate([box().points, box().points + 9])
    wrap = wrapped(points, np.concatenate([triangles(box()), triangles(box()) + 8]), alpha=0.05, offset=0.01)
    assert len(components(wrap)) == 2


def test_a_hole_smaller_than_alpha_is_closed() -> None:
    mesh = box()
    whole, open_box = (
        signed_volume(wrapped(mesh.points, triangles(mesh)[first:], alpha=0.7, offset=0.02)) for first in (0, 1)
    )
    assert open_box == pytest.approx(whole, rel=0.1)


def test_triangles_with_numbers_that_are_none_are_left_out() -> None:
    points = np.vstack([box().points, [np.nan, 0, 0], [np.inf, 1, 1]])
    soup = np.concatenate([triangles(box()), [[0, 1, 8], [9, 2, 3]]])
    assert len(finite_triangles(points, soup)) == 12
    wrap = wrapped(points, soup, alpha=0.1, offset=0.02)
    assert np.isfinite(wrap.points).all()
    with pytest.raises(MeshError, match="no faces with finite corners among 1 triangles"):
        wrapped(points, np.array([[0, 8, 9]]), alpha=0.1, offset=0.02)


@pytest.mark.parametrize("points", [np.zeros((3, 3)), np.outer([0, 1, 2], [1, 1, 1])])
def test_without_area_there_is_nothing_to_wrap(points: np.ndarray) -> None:
    with pytest.raises(MeshError, match="without area"):
        wrapped(points, np.array([[0, 1, 2]]), alpha=0.1, offset=0.02)


def test_nothing_is_printed(capfd: pytest.CaptureFixture[str]) -> None:
    wrapped(box().points, triangles(box()), alpha=0.2, offset=0.05)
    assert capfd.readouterr() == ("", "")


def test_triangles_are_polygons_of_three() -> None:
    mesh = from_triangles(box().points, triangles(box()))
    assert mesh.face_sizes.tolist() == 12 * [3]
