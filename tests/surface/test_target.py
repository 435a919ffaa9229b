"""Aims: outward from inside, inward from outside, through no other sheet, nearest where rays lead nowhere."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import on_sphere, seeds

from fabricate.surface.target import FALLBACK_WEIGHT, Target

BALL = trimesh.creation.icosphere(subdivisions=4)
SLAB = trimesh.creation.box(extents=(10, 10, 1))


def target_of(mesh: trimesh.Trimesh) -> Target:
    return Target.of(np.array(mesh.vertices), np.array(mesh.faces))


ONTO_BALL, ONTO_SLAB = target_of(BALL), target_of(SLAB)


@given(seed=seeds, radius=st.floats(0.6, 1.6))
def test_points_around_a_sphere_go_to_it_along_the_radius(seed: int, radius: float) -> None:
    normals = on_sphere(np.random.default_rng(seed).normal(size=(20, 3)))
    place, weight = ONTO_BALL.aims(radius * normals, normals, reach=0.7)
    np.testing.assert_allclose(place, normals * np.linalg.norm(place, axis=1, keepdims=True), atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(place, axis=1), 1, atol=3e-3)
    assert (weight == 1).all()


def test_what_is_out_of_reach_has_no_aim() -> None:
    normals = np.eye(3)
    place, weight = ONTO_BALL.aims(2 * normals, normals, reach=0.5)
    assert not weight.any()
    np.testing.assert_allclose(place, 2 * normals)


def test_a_point_that_faces_the_other_way_has_no_aim() -> None:
    outside = 1.2 * np.eye(3)
    assert not ONTO_BALL.aims(outside, -np.eye(3), reach=0.5).weight.any()


@pytest.mark.parametrize("height", [-0.45, 0.0, 0.45, 0.9])
def test_of_two_sheets_the_one_that_faces_the_same_way_is_meant(height: float) -> None:
    """A point near the underside still belongs to the upper side when it faces up."""
    place, weight = ONTO_SLAB.aims(np.array([[1.0, 2.0, height]]), np.array([[0.0, 0.0, 1.0]]), reach=2.0)
    np.testing.assert_allclose(place, [[1.0, 2.0, 0.5]], atol=1e-6)
    assert weight.tolist() == [1]


def test_where_rays_miss_the_nearest_place_is_meant() -> None:
    beside = np.array([[5.5, 0.0, 0.7]])
    place, weight = ONTO_SLAB.aims(beside, np.array([[0.0, 0.0, 1.0]]), reach=2.0)
    assert weight.tolist() in ([0], [FALLBACK_WEIGHT])
    slanted = np.array([[0.6, 0.0, -0.8]])
    place, weight = ONTO_SLAB.aims(beside, slanted, reach=2.0)
    assert weight.tolist() == [FALLBACK_WEIGHT]
    np.testing.assert_allclose(place, [[5.0, 0.0, 0.5]], atol=1e-6)


@given(seed=seeds)
def test_aims_lie_on_the_target(seed: int) -> None:
    random = np.random.default_rng(seed)
    points, normals = random.uniform(-1, 1, (30, 3)) * [6, 6, 1.5], on_sphere(random.normal(size=(30, 3)))
    place, weight = ONTO_SLAB.aims(points, normals, reach=3.0)
    off = ONTO_SLAB.tree.nearest(place).distance
    assert off[weight > 0].max(initial=0.0) < 1e-5
    assert (np.linalg.norm(place - points, axis=1) <= 3.0 + 1e-6).all()
