"""Splits, collapses and flips of edges: none changes the topology, and each does what it is for."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import HANDLES, bipyramid, octahedron, seeds, surfaces, tetrahedron

from fabricate.mesh.closed import checked_closed, genus, signed_volume
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.prepare.edge_operations import (
    TOO_LONG,
    TOO_SHORT,
    collapse_short_edges,
    flip_edges,
    split_long_edges,
)
from fabricate.prepare.triangle_mesh import TriangleMesh, edges, fanned
from fabricate.triangles.normals import area_vectors

BALL = fanned(sphere(faces="triangles", frequency=4))


def even(mesh: TriangleMesh, length: float) -> np.ndarray:
    return np.full(len(mesh.points), length)


@given(surfaces(), st.floats(0.05, 3), seeds)
def test_no_operation_changes_the_topology(mesh: PolygonMesh, length: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    made, lengths = split_long_edges(fanned(mesh), even(fanned(mesh), length))
    for _ in range(3):
        made, lengths = collapse_short_edges(made, lengths, rng)
        made = flip_edges(made)
    assert len(lengths) == len(made.points)
    assert genus(checked_closed(made.polygons)) == genus(mesh)


@given(surfaces())
def test_a_split_adds_one_point_and_two_triangles(mesh: PolygonMesh) -> None:
    before = fanned(mesh)
    after, lengths = split_long_edges(before, even(before, 0.3))
    assert len(after.triangles) - len(before.triangles) == 2 * (len(after.points) - len(before.points)) > 0
    assert (after.points[: len(before.points)] == before.points).all()
    assert (lengths == 0.3).all()


def test_splits_end_with_no_edge_too_long() -> None:
    mesh, lengths = fanned(octahedron()), even(fanned(octahedron()), 0.3)
    for _ in range(60):
        mesh, lengths = split_long_edges(mesh, lengths)
    assert edges(mesh).lengths(mesh.points).max() <= TOO_LONG * 0.3


def test_splits_leave_the_surface_as_it_is() -> None:
    made, _ = split_long_edges(BALL, even(BALL, 0.1))
    assert made.area == pytest.approx(BALL.area)
    assert signed_volume(made.polygons) == pytest.approx(signed_volume(BALL.polygons))


def test_collapses_end_with_few_edges_too_short() -> None:
    rng, mesh, lengths = np.random.default_rng(3), BALL, even(BALL, 0.7)
    for _ in range(40):
        mesh, lengths = collapse_short_edges(mesh, lengths, rng)
    assert len(mesh.points) < len(BALL.points) / 3
    assert np.mean(edges(mesh).lengths(mesh.points) < TOO_SHORT * 0.7) < 0.25


@pytest.mark.parametrize("name", HANDLES)
def test_collapses_stop_at_the_last_triangles_round_a_handle(name: str) -> None:
    mesh, handles = HANDLES[name]
    made, lengths = fanned(mesh), even(fanned(mesh), 100.0)
    for seed in range(30):
        made, lengths = collapse_short_edges(made, lengths, np.random.default_rng(seed))
    assert genus(checked_closed(made.polygons)) == handles
    assert handles > 0


def test_a_tetrahedron_cannot_be_collapsed() -> None:
    mesh = fanned(tetrahedron())
    made, _ = collapse_short_edges(mesh, even(mesh, 100.0), np.random.default_rng(0))
    assert len(made.triangles) == 4


@given(seeds)
def test_no_collapse_turns_a_triangle_over(seed: int) -> None:
    """On a flat top with a notch, shrinking the edge a - b to its middle would pull a across the line p - n."""
    flat = {"a": (-1, 0), "b": (1, 0), "u": (0, 1), "l": (-2, 0), "p": (-0.7, -1), "n": (-0.3, -0.1), "q": (1, -1)}
    names = [*flat, "r", "below"]
    points = np.array([[*place, 0] for place in flat.values()] + [[2, 0, 0], [0, 0, -3]], dtype=float)
    ring = ["u", "l", "p", "n", "q", "r"]
    faces = ["abu", "aul", "alp", "apn", "anb", "bnq", "bqr", "bru"]
    faces = [[names.index(corner) for corner in face] for face in faces]
    sides = [
        [names.index(v), names.index(w), names.index("below")] for v, w in zip(ring[1:] + ring[:1], ring, strict=True)
    ]
    mesh = fanned(checked_closed(PolygonMesh.from_faces(points, faces + sides)))
    rng, made, lengths = np.random.default_rng(seed), mesh, even(mesh, 100.0)
    for _ in range(10):
        made, lengths = collapse_short_edges(made, lengths, rng)
    assert len(made.points) < len(mesh.points)
    on_top = made.triangles[(np.abs(made.points[made.triangles][:, :, 2]) < 1e-9).all(axis=1)]
    assert (area_vectors(made.points, on_top)[:, 2] > 0).all()


@given(surfaces())
def test_a_flip_keeps_points_and_brings_valences_nearer_to_six(mesh: PolygonMesh) -> None:
    before = fanned(mesh)
    after = flip_edges(before)
    assert after.points is before.points
    assert len(after.triangles) == len(before.triangles)
    assert np.square(after.valence - 6).sum() <= np.square(before.valence - 6).sum()


def test_an_edge_flips_where_that_helps() -> None:
    """Of a flat double pyramid's fan of 16 triangles, edges to the middle flip; of a sharp one's, none may."""
    flat = bipyramid(16)
    flat = flat.moved(flat.points * [1, 1, 0.05])
    assert (flip_edges(fanned(flat)).triangles != fanned(flat).triangles).any()
    sharp = bipyramid(16)
    sharp = sharp.moved(sharp.points * [0.05, 0.05, 1])
    assert (flip_edges(fanned(sharp)).triangles == fanned(sharp).triangles).all()
