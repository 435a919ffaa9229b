"""Crossings: planted ones are found, and closed surfaces have none."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from igl.copyleft.cgal import remesh_self_intersections

from fabricate.triangles.crossing import BLOCK, crossing_triangles

FLAT = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], dtype=float)
UPRIGHT = np.array([[0, -0.2, -1], [0.1, -0.2, 1], [0, 0.2, 1]], dtype=float)
TWO = np.arange(6).reshape(2, 3)


def test_two_triangles_that_cross_are_one_pair() -> None:
    pairs = crossing_triangles(np.concatenate([FLAT, UPRIGHT]), TWO)
    assert pairs.tolist() == [[0, 1]]


@pytest.mark.parametrize("shift", [1.5, 10.0])
def test_two_triangles_beside_each_other_are_none(shift: float) -> None:
    points = np.concatenate([FLAT, UPRIGHT + np.array([0, 0, shift])])
    assert crossing_triangles(points, TWO).shape == (0, 2)


def test_the_test_is_exact() -> None:
    """The upright triangle's lowest corner reaches through the flat one by one unit in the last place, or not."""
    through = np.nextafter(0.0, -1.0)
    for height, found in ((through, 1), (np.nextafter(0.0, 1.0), 0)):
        tip = np.array([[0, 0, height], [0.1, 0, 1], [-0.1, 0, 1]])
        assert len(crossing_triangles(np.concatenate([FLAT, tip]), TWO)) == found


def test_neighbours_do_not_count() -> None:
    sphere = trimesh.creation.icosphere(subdivisions=2)
    assert len(crossing_triangles(np.asarray(sphere.vertices), np.asarray(sphere.faces))) == 0


def test_a_folded_sphere_does() -> None:
    sphere = trimesh.creation.icosphere(subdivisions=2)
    points = np.array(sphere.vertices)
    points[0] *= -1.5
    pairs = crossing_triangles(points, np.asarray(sphere.faces))
    assert len(pairs) > 0
    assert (sphere.faces[pairs] == 0).any(axis=(1, 2)).all()


def test_large_meshes_are_searched_as_a_whole() -> None:
    """Two spheres that cross along a circle through all blocks: each pair once, as in a search of all at once."""
    sphere = trimesh.creation.icosphere(subdivisions=6)
    points = np.concatenate([sphere.vertices, sphere.vertices + np.array([0.0, 0.5, 0.1])])
    triangles = np.concatenate([sphere.faces, sphere.faces + len(sphere.vertices)])
    assert len(triangles) > 2 * BLOCK
    pairs = crossing_triangles(points, triangles)
    at_once = np.sort(remesh_self_intersections(points, triangles, detect_only=True)[2], axis=1)
    assert pairs.tolist() == sorted(at_once.tolist())
    assert len(pairs) > 500


def test_nothing_crosses_nothing() -> None:
    assert crossing_triangles(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)).shape == (0, 2)
