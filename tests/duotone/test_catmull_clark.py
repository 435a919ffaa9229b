from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from creases import creased_surfaces, prism
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import HANDLES, face_lists, named, polyhedra, seeds, surfaces

from fabricate.duotone.catmull_clark import catmull_clark, subdivided
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.mesh.closed import check_closed_manifold, genus
from fabricate.mesh.half_edges import half_edges
from fabricate.mesh.polygon_mesh import PolygonMesh

MESHES = surfaces()
CREASED = creased_surfaces()


def as_polygons(quads: QuadMesh) -> PolygonMesh:
    return replace(PolygonMesh.from_faces(quads.points, quads.tiles.tolist()), creases=quads.creases)


def edge_count(mesh: PolygonMesh) -> int:
    return len(mesh.corners) // 2


def naive(mesh: PolygonMesh) -> tuple[np.ndarray, list[list[int]]]:
    """Subdivide with dictionaries, face by face, after the rules of Catmull and Clark, and of DeRose and others."""
    faces = face_lists(mesh)
    old = mesh.points
    centres = [np.mean([old[p] for p in face], axis=0) for face in faces]
    faces_at_edge: dict[frozenset[int], list[int]] = {}
    faces_at_point: dict[int, list[int]] = {}
    for number, face in enumerate(faces):
        for k, point in enumerate(face):
            faces_at_edge.setdefault(frozenset((point, face[(k + 1) % len(face)])), []).append(number)
            faces_at_point.setdefault(point, []).append(number)
    edges_at_point: dict[int, list[frozenset[int]]] = {}
    for edge in faces_at_edge:
        for point in edge:
            edges_at_point.setdefault(point, []).append(edge)

    heads = mesh.corners[mesh.next_corner]
    sharp = set(map(frozenset, np.stack([mesh.corners, heads], axis=1)[mesh.creases].tolist()))
    new_vertices = []
    for point in range(len(old)):
        beyond = [old[other] for edge in edges_at_point[point] if edge in sharp for other in edge - {point}]
        if len(beyond) >= 2:
            new_vertices.append((6 * old[point] + beyond[0] + beyond[1]) / 8 if len(beyond) == 2 else old[point])
            continue
        n = len(edges_at_point[point])
        around = np.mean([centres[face] for face in faces_at_point[point]], axis=0)
        middles = np.mean([np.mean([old[p] for p in edge], axis=0) for edge in edges_at_point[point]], axis=0)
        new_vertices.append((around + 2 * middles + (n - 3) * old[point]) / n)
    new_edges = [
        np.mean([*(old[p] for p in edge), *(centres[face] for face in ([] if edge in sharp else beside))], axis=0)
        for edge, beside in faces_at_edge.items()
    ]
    number_of = {edge: len(old) + len(faces) + k for k, edge in enumerate(faces_at_edge)}
    quads = [
        [
            point,
            number_of[frozenset((point, face[(k + 1) % len(face)]))],
            len(old) + number,
            number_of[frozenset((point, face[k - 1]))],
        ]
        for number, face in enumerate(faces)
        for k, point in enumerate(face)
    ]
    return np.array([*new_vertices, *centres, *new_edges]), quads


@given(mesh=MESHES)
def test_agrees_with_the_rules_applied_face_by_face(mesh: PolygonMesh) -> None:
    points, quads = naive(mesh)
    found = catmull_clark(mesh).mesh
    assert found.tiles.tolist() == quads
    np.testing.assert_allclose(found.points, points, atol=1e-14 * np.abs(points).max() * 10)


@given(mesh=polyhedra())
def test_agrees_with_the_rules_on_quads_too(mesh: PolygonMesh) -> None:
    once = catmull_clark(mesh).mesh
    points, quads = naive(as_polygons(once))
    twice = catmull_clark(once).mesh
    assert twice.tiles.tolist() == quads
    np.testing.assert_allclose(twice.points, points, atol=1e-13)


@given(mesh=CREASED)
def test_agrees_with_the_rules_for_creases(mesh: PolygonMesh) -> None:
    once = catmull_clark(mesh).mesh
    points, quads = naive(mesh)
    assert once.tiles.tolist() == quads
    np.testing.assert_allclose(once.points, points, atol=1e-13)
    points, quads = naive(as_polygons(once))
    twice = catmull_clark(once).mesh
    assert twice.tiles.tolist() == quads
    np.testing.assert_allclose(twice.points, points, atol=1e-13)


@given(mesh=CREASED)
def test_creases_go_on_along_both_halves_of_their_edge(mesh: PolygonMesh) -> None:
    quads = catmull_clark(mesh).mesh
    assert quads.creases.sum() == 2 * mesh.creases.sum()
    assert (quads.creases == quads.creases[quads.twins]).all()
    old = np.bincount(mesh.corners[mesh.creases], minlength=len(mesh.points))
    assert (quads.crease_counts[: len(old)] == old).all()
    assert set(quads.crease_counts[len(old) :].tolist()) <= {0, 2}
    ends = quads.tiles.ravel(), np.roll(quads.tiles, -1, axis=1).ravel()
    assert all((end[quads.creases] < len(old)).sum() == mesh.creases.sum() for end in ends)


@given(mesh=MESHES)
def test_where_everything_is_a_crease_points_are_inserted_and_none_moved(mesh: PolygonMesh) -> None:
    quads = catmull_clark(replace(mesh, creases=np.ones(len(mesh.corners), dtype=bool))).mesh
    held = quads.crease_counts[: len(mesh.points)] > 2
    assert (quads.points[: len(mesh.points)][held] == mesh.points[held]).all()
    middles = (mesh.points[mesh.corners] + mesh.points[mesh.corners[mesh.next_corner]]) / 2
    np.testing.assert_allclose(quads.points[quads.tiles[:, 1]], middles, atol=1e-15)


@given(mesh=CREASED)
def test_a_single_crease_changes_only_its_own_edge_point(mesh: PolygonMesh) -> None:
    edge = half_edges(mesh).edge
    smooth, one = (replace(mesh, creases=edge == number) for number in (-1, 0))
    moved = (catmull_clark(smooth).mesh.points != catmull_clark(one).mesh.points).any(axis=1)
    assert np.flatnonzero(moved).tolist() in ([], [len(mesh.points) + len(mesh.offsets) - 1])


def test_flat_caps_between_creases_stay_flat_and_their_rims_straight_up() -> None:
    quads = subdivided(prism(7, height=2.0), levels=3)
    rims = quads.crease_counts == 2
    assert rims.sum() == 2 * 7 * 8
    np.testing.assert_allclose(np.abs(quads.points[rims, 2]), 1, atol=1e-15)
    assert np.isclose(np.abs(quads.points[:, 2]), 1, atol=1e-15).sum() > 2 * 7 * 16


@given(mesh=MESHES)
def test_counts(mesh: PolygonMesh) -> None:
    vertices, edges, faces = len(mesh.points), edge_count(mesh), len(mesh.offsets) - 1
    quads = catmull_clark(mesh).mesh
    assert len(quads.points) == vertices + faces + edges
    assert len(quads.tiles) == 2 * edges
    assert quads.yellow.sum() == edges + 2 - 2 * genus(mesh)
    assert (~quads.yellow).sum() == edges


@given(mesh=MESHES)
def test_result_is_closed_and_keeps_its_genus(mesh: PolygonMesh) -> None:
    quads = catmull_clark(mesh).mesh
    polygons = as_polygons(quads)
    check_closed_manifold(polygons)
    assert genus(polygons) == quads.genus == genus(mesh)


@pytest.mark.parametrize("name", HANDLES)
def test_genus_is_the_one_the_shape_is_known_for(name: str) -> None:
    mesh, handles = HANDLES[name]
    assert subdivided(mesh, levels=2).genus == handles


@given(mesh=MESHES)
def test_every_quad_runs_yellow_blue_yellow_blue(mesh: PolygonMesh) -> None:
    quads = catmull_clark(mesh).mesh
    assert (quads.yellow[quads.tiles] == [True, False, True, False]).all()
    finer = catmull_clark(quads).mesh
    assert (finer.yellow[finer.tiles] == [True, False, True, False]).all()


@given(mesh=MESHES)
def test_twins_are_involutive_and_run_opposite(mesh: PolygonMesh) -> None:
    for quads in (catmull_clark(mesh).mesh, subdivided(mesh, levels=2)):
        found = quads.half_edges
        numbers = np.arange(4 * len(quads.tiles))
        assert (quads.twins[quads.twins] == numbers).all()
        assert (quads.twins != numbers).all()
        assert (found.tail[quads.twins] == found.tail[found.following]).all()
        assert (found.tail[found.following[quads.twins]] == found.tail).all()


@given(mesh=st.one_of(MESHES, CREASED))
def test_matrix_makes_the_points_and_its_rows_are_means(mesh: PolygonMesh) -> None:
    quads, matrix = catmull_clark(mesh)
    assert matrix.shape == (len(quads.points), len(mesh.points))
    assert (matrix @ mesh.points == quads.points).all()
    np.testing.assert_allclose(matrix.sum(axis=1), 1, atol=1e-14)
    assert matrix.min() >= 0


@given(mesh=st.one_of(MESHES, CREASED), seed=seeds)
def test_subdivision_follows_every_affine_map(mesh: PolygonMesh, seed: int) -> None:
    rng = np.random.default_rng(seed)
    linear, shift = rng.normal(size=(3, 3)), rng.normal(size=3)
    moved = catmull_clark(mesh.moved(mesh.points @ linear + shift)).mesh.points
    np.testing.assert_allclose(moved, catmull_clark(mesh).mesh.points @ linear + shift, atol=1e-12)


@given(mesh=polyhedra(), levels=st.integers(1, 3))
def test_levels_are_repeated_steps(mesh: PolygonMesh, levels: int) -> None:
    quads = catmull_clark(mesh).mesh
    for _ in range(levels - 1):
        quads = catmull_clark(as_polygons(quads)).mesh
    found = subdivided(mesh, levels=levels)
    assert (found.tiles == quads.tiles).all()
    assert (found.twins == quads.twins).all()
    assert (found.yellow == quads.yellow).all()
    np.testing.assert_allclose(found.points, quads.points, atol=1e-14)


@pytest.mark.parametrize("name", named())
def test_the_old_mesh_is_left_alone(name: str) -> None:
    mesh = named()[name]
    points, corners = mesh.points.copy(), mesh.corners.copy()
    subdivided(mesh, levels=2)
    assert (mesh.points == points).all()
    assert (mesh.corners == corners).all()
