"""Edges of whole and broken meshes: counts known by Euler, and the fans and loops of small hand-made cases."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import directed_edges, face_lists, octahedron, surfaces, tetrahedron

from fabricate.mesh.edges import (
    Edges,
    InnerEdges,
    boundary_loops,
    connected,
    fans,
    fans_per_point,
    point_components,
    sheets,
)
from fabricate.mesh.polygon_mesh import PolygonMesh


def part_of(mesh: PolygonMesh, keep: set[int]) -> PolygonMesh:
    return PolygonMesh.from_faces(mesh.points, [face for n, face in enumerate(face_lists(mesh)) if n in keep])


@given(surfaces())
def test_a_closed_surface_has_two_agreeing_faces_at_each_edge_and_one_fan_at_each_point(mesh: PolygonMesh) -> None:
    edges = Edges.of(mesh)
    inner = InnerEdges.of(mesh, edges)
    assert (edges.faces == 2).all()
    assert len(inner.sides) == len(edges.ends) == len(mesh.corners) // 2
    assert inner.agree.all()
    assert not sheets(mesh, inner).one_sided.any()
    assert (fans_per_point(mesh, fans(mesh, edges)) == 1).all()
    assert len(boundary_loops(mesh, edges, fans(mesh, edges))[0]) == 0
    assert point_components(mesh, edges).max() == 0


@given(surfaces(), st.sets(st.integers(0, 200), min_size=1, max_size=5))
def test_faces_at_edges_are_those_counted_one_by_one(mesh: PolygonMesh, lost: set[int]) -> None:
    broken = part_of(mesh, {n for n in range(len(mesh.offsets) - 1) if n not in lost})
    edges = Edges.of(broken)
    counts = Counter(frozenset(edge) for edge in directed_edges(face_lists(broken)))
    assert {frozenset(ends): n for ends, n in zip(edges.ends.tolist(), edges.faces.tolist(), strict=True)} == counts
    firsts = broken.corners[edges.first_corner]
    assert ((firsts == edges.ends[:, 0]) | (firsts == edges.ends[:, 1])).all()


def test_each_missing_face_is_a_loop() -> None:
    faces = face_lists(octahedron())
    opposite = next(n for n, face in enumerate(faces) if not set(face) & set(faces[0]))
    mesh = part_of(octahedron(), set(range(8)) - {0, opposite})
    edges = Edges.of(mesh)
    rim, loop = boundary_loops(mesh, edges, fans(mesh, edges))
    assert np.bincount(loop).tolist() == [3, 3]
    found = {frozenset(mesh.corners[rim[loop == number]].tolist()) for number in (0, 1)}
    assert found == {frozenset(faces[0]), frozenset(faces[opposite])}


def test_sheets_that_touch_in_a_point_have_a_loop_each() -> None:
    mesh = PolygonMesh.from_faces(np.random.default_rng(0).random((6, 3)), [[0, 1, 2], [0, 3, 4, 5]])
    edges = Edges.of(mesh)
    fan = fans(mesh, edges)
    assert np.bincount(boundary_loops(mesh, edges, fan)[1]).tolist() == [3, 4]
    assert fans_per_point(mesh, fan).tolist() == [2, 1, 1, 1, 1, 1]


def test_a_fan_goes_on_over_an_edge_of_three_faces_and_over_faces_wound_against_each_other() -> None:
    points = np.random.default_rng(0).random((5, 3))
    book = PolygonMesh.from_faces(points, [[0, 1, 2], [0, 1, 3], [1, 0, 4]])
    edges = Edges.of(book)
    assert edges.faces.max() == 3
    assert (fans_per_point(book, fans(book, edges)) == 1).all()


def test_two_tetrahedra_on_one_point_are_two_fans_there() -> None:
    faces = face_lists(tetrahedron())
    other = [[corner + 4 if corner else 0 for corner in face] for face in faces]
    mesh = PolygonMesh.from_faces(np.random.default_rng(0).random((8, 3)), faces + other)
    assert fans_per_point(mesh, fans(mesh, Edges.of(mesh))).tolist() == [2, 1, 1, 1, 0, 1, 1, 1]


def test_a_moebius_strip_has_one_side() -> None:
    strip = [(i, i + 1, i + 6, i + 5) for i in range(4)] + [(4, 5, 0, 9)]
    mesh = PolygonMesh.from_faces(np.random.default_rng(1).random((10, 3)), strip)
    assert sheets(mesh, InnerEdges.of(mesh, Edges.of(mesh))).one_sided.all()


def test_nodes_without_links_are_their_own_components() -> None:
    assert connected(4, np.array([[1, 3]])).tolist() == [0, 1, 2, 1]


def test_the_arrays_cannot_be_written_to() -> None:
    edges = Edges.of(tetrahedron())
    for array in (edges.ends, edges.of_corner, edges.faces, InnerEdges.of(tetrahedron(), edges).sides):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
