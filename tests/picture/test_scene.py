"""Scenes: colours follow the parts, normals are smooth on smooth bodies and sharp at creases."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from fabricate.picture.scene import corner_normals, facet_normals, scene_of_parts
from fabricate.solid.part import Part


def part(mesh: trimesh.Trimesh, name: str = "yellow") -> Part:
    return Part(name, mesh.vertices, mesh.faces)


BALL = part(trimesh.creation.icosphere(subdivisions=3, radius=10))
BOX = part(trimesh.creation.box((2, 3, 4)), "blue")


def test_each_triangle_has_the_colour_and_the_corners_of_its_part() -> None:
    scene = scene_of_parts([BALL, BOX], [(255, 0, 0), (0, 0, 255)])
    assert np.bincount(scene.colour_of).tolist() == [len(BALL.triangles), 12]
    np.testing.assert_array_equal(scene.colours, [[1, 0, 0], [0, 0, 1]])
    np.testing.assert_array_equal(scene.points[scene.triangles[-12:]], BOX.points[BOX.triangles])


def test_facet_normals_are_unit_and_point_outwards() -> None:
    normals = facet_normals(scene_of_parts([BOX], [(0, 0, 0)]))
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-6)
    middles = BOX.points[BOX.triangles].mean(axis=1)
    assert (np.einsum("mx,mx->m", normals, middles) > 0).all()


def test_normals_of_a_ball_are_smooth_and_point_outwards() -> None:
    scene = scene_of_parts([BALL], [(0, 0, 0)])
    normals = corner_normals(scene, facet_normals(scene), crease=30)
    cosines = np.einsum("mcx,mcx->mc", normals, scene.points[scene.triangles]) / 10
    assert cosines.min() > np.cos(np.radians(1.5))


def test_normals_of_a_box_are_those_of_its_sides() -> None:
    scene = scene_of_parts([BOX], [(0, 0, 0)])
    normals = corner_normals(scene, facet_normals(scene), crease=30)
    assert set(np.unique(np.abs(normals))) == {0.0, 1.0}
    assert (normals == normals[:, :1]).all()


def test_a_triangle_without_area_has_no_normal_and_breaks_nothing() -> None:
    points = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]])
    flat = Part("flat", points, np.array([[0, 1, 2], [0, 1, 3]]))
    scene = scene_of_parts([flat], [(0, 0, 0)])
    assert np.isfinite(corner_normals(scene, facet_normals(scene), crease=30)).all()


def test_nobody_can_edit_a_scene() -> None:
    with pytest.raises(ValueError, match="read-only"):
        scene_of_parts([BOX], [(0, 0, 0)]).points[0] = 0
