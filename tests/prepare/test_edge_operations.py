"""Splits, collapses and flips of edges: none changes the topology, and each does what it is for."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import HANDLES, bipyramid, octahedron, seeds, surfaces, tetrahedron

from fabricate.mesh.closed import checked_closed, genus
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


def test_split_edges_bow_out_to_a_ball() -> None:
    """The middle of an edge between unit normals lies on the ball to fourth order, and the plain middle to second."""
    made, _ = split_long_edges(BALL, even(BALL, 0.1))
    new = np.linalg.norm(made.points[len(BALL.points) :], axis=1)
    sag = 1 - np.cos(np.arcsin(edges(BALL).lengths(BALL.points).max() / 2))
    assert np.abs(new - 1).max() < 0.15 * sag


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


def test_a_collapse_that_would_turn_a_triangle_over_is_left_out() -> None:
    """A fan of quads' halves round an edge, with a notch that reaches almost to one end, which may not cross it.

    The ring is flat, its points 0 to 5 lie round the edge 6 - 7, and point 3 reaches in to beyond the edge's middle
    from below: seen from there, the edge's end 6 may not move to the middle.
    """
    ring = [[1, 0], [0.5, 0.9], [-0.5, 0.9], [-1, 0], [-0.5, -0.9], [0.1, -0.02], [0.5, -0.9]]
    points = np.array([[*place, 0.0] for place in [*ring, (-0.4, 0), (0.4, 0)]] + [[0, 0, -1]])
    left, right, below = 7, 8, 9
    top = [[1, 2, left], [2, 3, left], [3, 4, left], [4, 5, left], [5, right, left]]
    top += [[5, 6, right], [6, 0, right], [0, 1, right], [1, left, right]]
    bottom = [[(k + 1) % 7, k, below] for k in range(7)]
    mesh = fanned(checked_closed(PolygonMesh.from_faces(points, top + bottom)))
    only_inside = np.where(np.isin(np.arange(10), [left, right]), 2.0, 0.01)
    free = TriangleMesh(points * [[1, 1, 1]] * 5 + [[0, -4 * 0.9, 0]] * (np.arange(10) == 5)[:, None], mesh.triangles)
    assert len(collapse_short_edges(mesh, only_inside, np.random.default_rng(0))[0].points) == 10
    assert len(collapse_short_edges(free, 5 * only_inside, np.random.default_rng(0))[0].points) == 9


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
