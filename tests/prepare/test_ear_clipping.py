"""Ear clipping: every polygon is covered exactly, whatever its outline; shapely tells areas of flat ones."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import directed_edges, face_lists, seeds, surfaces

from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.ear_clipping import LARGEST_CLIPPED, ear_clipped
from fabricate.triangles.normals import area_vectors


def star(rng: np.random.Generator, corners: int) -> np.ndarray:
    """Return a simple polygon in the plane, mostly concave, counter-clockwise."""
    angle = np.sort(rng.uniform(0, 2 * np.pi, corners)) * 0.4 + np.linspace(0, 0.6 * 2 * np.pi, corners, endpoint=False)
    radius = rng.uniform(0.2, 1, corners)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def one_face(points: np.ndarray) -> PolygonMesh:
    return PolygonMesh.from_faces(points, [range(len(points))])


@given(seeds, st.integers(3, 40))
def test_flat_polygons_are_covered_once_within_their_outline(seed: int, corners: int) -> None:
    rng = np.random.default_rng(seed)
    flat = star(rng, corners)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)  # a rotation, so that counter-clockwise stays so
    points = np.column_stack([flat, np.full(corners, 0.3)]) @ turn.T
    cut = ear_clipped(one_face(points)).triangles
    assert len(cut) == corners - 2
    vectors = area_vectors(points, cut) @ turn / 2
    assert (vectors[:, 2] > -1e-12).all()
    outline = shapely.Polygon(flat)
    assert vectors[:, 2].sum() == pytest.approx(outline.area)
    assert all(outline.buffer(1e-9).covers(shapely.Polygon(flat[triangle])) for triangle in cut)


@settings(max_examples=50)
@given(surfaces())
def test_triangles_of_a_surface_have_the_boundary_of_its_polygons(mesh: PolygonMesh) -> None:
    cut = ear_clipped(mesh)
    assert np.bincount(cut.face).tolist() == (mesh.face_sizes - 2).tolist()
    for number, face in enumerate(face_lists(mesh)):
        edges = Counter(directed_edges(cut.triangles[cut.face == number].tolist()))
        inner = {edge for edge in edges if edge[::-1] in edges}
        assert edges - Counter(inner) == Counter(directed_edges([face]))


def test_a_bent_quad_is_cut_along_the_shorter_diagonal() -> None:
    points = np.array([[0, 0, 0], [1, -0.2, 0.3], [2, 0, 0], [1, 0.2, 0.3]], dtype=float)
    for turn in range(4):
        cut = ear_clipped(one_face(np.roll(points, turn, axis=0))).triangles
        shared = set(cut[0].tolist()) & set(cut[1].tolist())
        assert shared == {(1 + turn) % 4, (3 + turn) % 4}


def test_corners_in_a_row_on_an_edge_make_no_triangle_outside() -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0], [3, 2, 0], [0, 2, 0]], dtype=float)
    vectors = area_vectors(points, ear_clipped(one_face(points)).triangles)
    assert (vectors[:, 2] >= 0).all()
    assert vectors[:, 2].sum() == pytest.approx(12)


def test_a_face_with_a_bridge_to_its_hole_is_covered_once() -> None:
    outer, hole = [[0, 0], [4, 0], [4, 4], [0, 4]], [[1, 1], [1, 3], [3, 3], [3, 1]]
    points = np.column_stack([outer + hole, np.zeros(8)])
    mesh = PolygonMesh.from_faces(points, [[0, 1, 2, 3, 0, 4, 5, 6, 7, 4]])
    vectors = area_vectors(points, ear_clipped(mesh).triangles)
    assert (vectors[:, 2] >= 0).all()
    assert vectors[:, 2].sum() == pytest.approx(2 * (16 - 4))


@pytest.mark.parametrize("corners", [[0, 1, 0, 1], [0, 0, 0, 0], [0, 1, 2, 2, 1]])
def test_polygons_without_sense_get_as_many_triangles(corners: list[int]) -> None:
    mesh = PolygonMesh.from_faces(np.eye(3), [corners])
    assert len(ear_clipped(mesh).triangles) == len(corners) - 2


def test_huge_polygons_are_fans() -> None:
    angle = np.linspace(0, 2 * np.pi, LARGEST_CLIPPED + 1, endpoint=False)
    points = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    vectors = area_vectors(points, ear_clipped(one_face(points)).triangles)
    assert vectors[:, 2].sum() / 2 == pytest.approx(np.pi, rel=1e-5)


def test_no_faces_have_no_triangles() -> None:
    cut = ear_clipped(PolygonMesh.from_faces(np.zeros((0, 3)), []))
    assert cut.triangles.shape == (0, 3)
    assert cut.face.shape == (0,)
