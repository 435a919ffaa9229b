"""Diagnosis: the facts of meshes made by hand, and laws on whole and broken surfaces."""

from __future__ import annotations

import numpy as np
import pytest
from breaking import box, inside_out, moebius, turned, united, unwelded, with_faces, without
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import HANDLES, face_lists, surfaces

from fabricate.mesh.closed import genus
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.diagnosis import MOST_LISTED, Component, Diagnosis, Found, Kind, diagnosed

NOTHING = Found(0, ())
FAULTS = (
    "nonmanifold_edges",
    "nonmanifold_vertices",
    "inconsistent_edges",
    "degenerate_faces",
    "duplicate_faces",
    "coinciding_points",
    "crossings",
)


def faults(diagnosis: Diagnosis) -> dict[str, int]:
    found = {name: getattr(diagnosis, name).count for name in FAULTS}
    return {name: count for name, count in found.items() if count}


@settings(max_examples=50)
@given(surfaces())
def test_a_clean_surface_has_its_genus_and_no_topological_fault(mesh: PolygonMesh) -> None:
    found = diagnosed(mesh)
    assert found.largest_components == (Component(len(mesh.offsets) - 1, genus(mesh), 1),)
    assert (found.boundary_loops, found.nonmanifold_edges.count, found.inconsistent_edges.count) == (0, 0, 0)
    assert faults(found).keys() <= {"crossings"}  # bent polygons may
    assert (found.boundary_loops, found.unreferenced_points, found.non_orientable) == (0, 0, False)
    assert sum(kind.corners * kind.faces for kind in found.polygons) == len(mesh.corners)
    assert sum(kind.faces for kind in found.polygons) == found.faces


def test_a_box_is_described() -> None:
    found = diagnosed(box(2.0, at=(5, 0, 0)))
    assert found.polygons == (Kind(4, 6),)
    assert (found.vertices, found.faces, found.components) == (8, 6, 1)
    assert found.size == pytest.approx((2, 2, 2))
    assert found.diagonal == pytest.approx(np.sqrt(12))
    assert found.thinnest is not None
    assert found.thinnest.value == pytest.approx(2, rel=1e-4)


def test_a_hole_is_a_loop_with_its_length() -> None:
    found = diagnosed(without(box(2.0), {0}))
    assert found.boundary_loops == 1
    assert (found.longest_loops[0].edges, found.longest_loops[0].length) == (4, pytest.approx(8))
    assert found.largest_components == (Component(5, None, None),)
    assert found.thinnest is None


def test_flips_are_edges_wound_inconsistently_with_a_genus_all_the_same() -> None:
    found = diagnosed(turned(box(), {0}))
    assert faults(found) == {"inconsistent_edges": 4}
    assert found.largest_components == (Component(6, 0, None),)
    assert found.thinnest is None


def test_inside_out_and_cavities_have_a_negative_sign() -> None:
    assert diagnosed(inside_out(box())).largest_components[0].volume_sign == -1
    hollow = diagnosed(united(box(4.0), inside_out(box(2.0))))
    assert [component.volume_sign for component in hollow.largest_components] == [1, -1]
    assert hollow.thinnest is not None
    assert hollow.thinnest.value == pytest.approx(1, rel=1e-4)  # between the cavity and the outside
    turned_whole = diagnosed(inside_out(box(3.0)))
    assert turned_whole.thinnest is not None
    assert turned_whole.thinnest.value == pytest.approx(3, rel=1e-4)


def test_two_boxes_on_an_edge_have_a_non_manifold_edge_at_its_place() -> None:
    first, second = box(), box(at=(1, 1, 0))
    both = united(first, second)
    merged = np.unique(both.points, axis=0, return_inverse=True)
    mesh = PolygonMesh(merged[0], merged[1].ravel()[both.corners], both.offsets)
    found = diagnosed(mesh)
    assert found.nonmanifold_edges.count == 1
    assert found.nonmanifold_edges.places[0] == pytest.approx((0.5, 0.5, 0))
    assert found.largest_components == (Component(12, None, None),)


def test_two_boxes_on_a_point_have_a_non_manifold_vertex_at_its_place() -> None:
    both = united(box(), box(at=(1, 1, 1)))
    merged = np.unique(both.points, axis=0, return_inverse=True)
    found = diagnosed(PolygonMesh(merged[0], merged[1].ravel()[both.corners], both.offsets))
    assert faults(found) == {"nonmanifold_vertices": 1}
    assert found.nonmanifold_vertices.places[0] == pytest.approx((0.5, 0.5, 0.5))
    assert found.largest_components[0].genus is None


def test_a_moebius_strip_is_one_sided() -> None:
    found = diagnosed(moebius())
    assert found.non_orientable
    assert (found.boundary_loops, found.longest_loops[0].edges) == (1, 24)
    assert found.inconsistent_edges.count > 0


def test_copies_and_degenerate_faces_are_counted() -> None:
    faces = face_lists(box())
    found = diagnosed(with_faces(box(), [*faces, faces[0][::-1], [0, 1, 1]]))
    assert found.duplicate_faces.count == 1
    assert found.degenerate_faces.count == 1
    line = PolygonMesh.from_faces(np.outer([0, 1, 2], [1, 2, 3]), [[0, 1, 2]])
    assert faults(diagnosed(line)) == {"degenerate_faces": 1}


def test_an_unwelded_box_has_coinciding_points_and_no_crossings() -> None:
    found = diagnosed(unwelded(box()))
    assert faults(found) == {"coinciding_points": 16}
    assert (found.components, found.boundary_loops) == (6, 6)


def test_points_without_a_face_are_counted_and_have_no_say_in_the_size() -> None:
    found = diagnosed(PolygonMesh(np.vstack([box().points, [9, 9, 9]]), box().corners, box().offsets))
    assert found.unreferenced_points == 1
    assert found.size == pytest.approx((1, 1, 1))


def test_boxes_in_each_other_cross() -> None:
    found = diagnosed(united(box(), box(at=(0.5, 0.4, 0.3))))
    assert found.crossings.count > 0
    assert found.crossings_complete
    assert all(-0.5 <= value <= 1 for place in found.crossings.places for value in place)


def test_handles_are_counted_per_component() -> None:
    rings = [mesh.moved(mesh.points + 50 * n) for n, (mesh, _) in enumerate(HANDLES.values())]
    found = diagnosed(united(*rings))
    expected = sorted(((len(mesh.offsets) - 1, handles) for mesh, handles in HANDLES.values()), reverse=True)
    assert sorted(((part.faces, part.genus) for part in found.largest_components), reverse=True) == expected


@given(st.integers(1, 3 * MOST_LISTED))
@settings(max_examples=5)
def test_lists_are_bounded_and_counts_are_not(count: int) -> None:
    triangles = PolygonMesh(
        np.random.default_rng(0).random((3 * count, 3)), np.arange(3 * count), 3 * np.arange(count + 1)
    )
    found = diagnosed(triangles)
    assert found.components == found.boundary_loops == count
    assert len(found.largest_components) == len(found.longest_loops) == min(count, MOST_LISTED)
    assert len(found.crossings.places) == min(found.crossings.count, MOST_LISTED)
