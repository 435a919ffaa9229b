from __future__ import annotations

import re
from itertools import pairwise

import networkx as nx
import numpy as np
import pytest
from creases import SHARES, creased_quad_meshes, with_random_creases
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import beads, directed_edges, face_lists, polyhedra, quad_meshes, seeds, surfaces, tetrahedron

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
from fabricate.errors import PatternError
from fabricate.mesh.cube import cube
from fabricate.mesh.half_edges import half_edges
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import dodecahedron
from fabricate.mesh.torus import torus

EVEN = st.integers(2, 6).map(lambda half: 2 * half)
ODD = st.integers(1, 5).map(lambda half: 2 * half + 1)


def crease_lines(points: np.ndarray, tail: np.ndarray, head: np.ndarray) -> set[tuple[float, ...]]:
    """Return where the directed edges run, whatever their numbers."""
    return {tuple(place) for place in np.hstack([points[tail], points[head]]).tolist()}


def relabelled(mesh: PolygonMesh, seed: int) -> PolygonMesh:
    """Return the mesh with its points and faces in another order and each face begun elsewhere."""
    rng = np.random.default_rng(seed)
    number = rng.permutation(len(mesh.points))
    faces = [np.roll(number[face], rng.integers(len(face))).tolist() for face in face_lists(mesh)]
    points = mesh.points[np.argsort(number)]
    return PolygonMesh.from_faces(points, [faces[k] for k in rng.permutation(len(faces))])


def edge_graph(mesh: PolygonMesh) -> nx.Graph:
    return nx.Graph(directed_edges(face_lists(mesh)))


def assert_sound(quads: QuadMesh, mesh: PolygonMesh) -> None:
    """Assert that the quads are the mesh's own faces, coloured in turn and rightly connected."""
    assert (quads.points == mesh.points).all()
    assert {frozenset(tile) for tile in quads.tiles.tolist()} == {frozenset(face) for face in face_lists(mesh)}
    assert sorted(directed_edges(quads.tiles.tolist())) == sorted(directed_edges(face_lists(mesh)))
    assert (quads.yellow[quads.tiles] == [True, False, True, False]).all()
    found = half_edges(PolygonMesh.from_faces(quads.points, quads.tiles.tolist()))
    assert (quads.twins == found.twin).all()


@given(around=EVEN, across=EVEN, seed=seeds)
def test_even_torus_is_coloured_as_it_is(around: int, across: int, seed: int) -> None:
    mesh = relabelled(torus(around=around, across=across, tube=0.3), seed)
    quads = two_coloured(mesh)
    assert_sound(quads, mesh)
    assert quads.yellow[0]
    assert quads.yellow.sum() == around * across / 2
    assert quads.genus == 1


@given(mesh=surfaces(), seed=seeds)
def test_quads_of_any_surface_find_their_colours_again(mesh: PolygonMesh, seed: int) -> None:
    quads = subdivided(mesh, levels=1)
    polygons = relabelled(PolygonMesh.from_faces(quads.points, quads.tiles.tolist()), seed)
    found = two_coloured(polygons)
    assert_sound(found, polygons)
    known = nx.bipartite.color(edge_graph(polygons))
    assert found.yellow.tolist() == [known[point] == known[0] for point in range(len(known))]


@given(count=st.integers(2, 9), seed=seeds)
def test_quads_that_share_three_points_are_coloured_too(count: int, seed: int) -> None:
    mesh = relabelled(beads(count), seed)
    assert_sound(two_coloured(mesh), mesh)


@given(divisions=st.integers(1, 6), seed=seeds)
def test_divided_cubes_have_two_colours(divisions: int, seed: int) -> None:
    mesh = relabelled(cube(divisions=divisions), seed)
    assert_sound(two_coloured(mesh), mesh)


@given(counts=st.one_of(st.tuples(ODD, ODD), st.tuples(ODD, EVEN), st.tuples(EVEN, ODD)), seed=seeds)
def test_odd_torus_is_an_error_that_names_an_odd_cycle(counts: tuple[int, int], seed: int) -> None:
    mesh = relabelled(torus(around=counts[0], across=counts[1], tube=0.3), seed)
    with pytest.raises(PatternError, match="use levels = 1 or more") as caught:
        two_coloured(mesh)
    message = str(caught.value)
    found = re.search(r"points ([\d -]+) form an odd cycle of (\d+) edges", message)
    assert found is not None
    cycle = [int(name) for name in found[1].split(" - ")]
    assert cycle[0] == cycle[-1]
    assert len(cycle) - 1 == int(found[2])
    assert int(found[2]) % 2 == 1
    assert len(set(cycle)) == len(cycle) - 1
    assert all(edge_graph(mesh).has_edge(a, b) for a, b in pairwise(cycle))
    assert "\n" not in message


def test_of_a_long_odd_cycle_only_some_points_are_named() -> None:
    mesh = torus(around=301, across=302, tube=0.3)
    with pytest.raises(
        PatternError, match=r"points [\d -]+ \.\.\. - \d+ - \d+ form an odd cycle of \d{3} edges"
    ) as caught:
        two_coloured(mesh)
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize(
    ("mesh", "others", "first", "corners"),
    [(tetrahedron(), 4, 0, 3), (dodecahedron(), 12, 0, 5)],
)
def test_other_faces_than_quads_are_an_error(mesh: PolygonMesh, others: int, first: int, corners: int) -> None:
    message = f"found {others} other faces, the first is face {first} with {corners} corners"
    with pytest.raises(PatternError, match=message):
        two_coloured(mesh)


def test_one_triangle_among_quads_is_found() -> None:
    quads = cube(divisions=2)
    faces = face_lists(quads)
    a, b, c, d = faces[7]
    mesh = PolygonMesh.from_faces(quads.points, [*faces[:7], [a, b, c], [a, c, d], *faces[8:]])
    with pytest.raises(PatternError, match="found 2 other faces, the first is face 7 with 3 corners"):
        two_coloured(mesh)


@given(quads=quad_meshes())
def test_half_edges_are_those_of_the_same_polygons(quads: QuadMesh) -> None:
    mine = quads.half_edges
    other = half_edges(PolygonMesh.from_faces(quads.points, quads.tiles.tolist()))
    for name in ("tail", "following", "preceding", "face", "twin"):
        assert (getattr(mine, name) == getattr(other, name)).all()


@given(mesh=polyhedra())
def test_sphere_has_no_handle(mesh: PolygonMesh) -> None:
    assert subdivided(mesh, levels=1).genus == 0


@given(divisions=st.integers(1, 4), share=SHARES, seed=seeds)
def test_creases_stay_on_their_edges_when_quads_are_turned(divisions: int, share: float, seed: int) -> None:
    mesh = with_random_creases(relabelled(cube(divisions=divisions), seed), share=share, seed=seed)
    quads = two_coloured(mesh)
    connectivity = quads.half_edges
    head = connectivity.tail[connectivity.following]
    found = crease_lines(quads.points, connectivity.tail[quads.creases], head[quads.creases])
    wanted = crease_lines(mesh.points, mesh.corners[mesh.creases], mesh.corners[mesh.next_corner][mesh.creases])
    assert found == wanted
    assert (quads.creases == quads.creases[quads.twins]).all()


@given(quads=creased_quad_meshes())
def test_crease_counts_are_degrees_in_the_graph_of_creases(quads: QuadMesh) -> None:
    connectivity = quads.half_edges
    ends = np.stack([connectivity.tail, connectivity.tail[connectivity.following]], axis=1)
    first = quads.creases & (np.arange(len(quads.twins)) < quads.twins)
    graph = nx.MultiGraph(ends[first].tolist())
    assert quads.crease_counts.tolist() == [graph.degree(k) if k in graph else 0 for k in range(len(quads.points))]


def test_without_being_told_no_side_is_a_crease() -> None:
    quads = two_coloured(cube(divisions=2))
    assert quads.creases.shape == quads.twins.shape
    assert not quads.creases.any()
    assert not quads.crease_counts.any()


@pytest.mark.parametrize("name", ["points", "tiles", "twins", "yellow", "creases"])
def test_arrays_are_frozen(name: str) -> None:
    quads = two_coloured(cube(divisions=1))
    with pytest.raises(ValueError, match="read-only"):
        getattr(quads, name)[0] = 0


def test_arrays_that_do_not_fit_each_other_are_an_error() -> None:
    quads = two_coloured(cube(divisions=1))
    with pytest.raises(ValueError, match=r"shape \(24\), found \(23,\)"):
        QuadMesh(quads.points, quads.tiles, quads.twins[:-1], quads.yellow)
    with pytest.raises(ValueError, match=r"shape \(8\), found \(7,\)"):
        QuadMesh(quads.points, quads.tiles, quads.twins, quads.yellow[:-1])
    with pytest.raises(ValueError, match=r"shape \(24\), found \(1,\)"):
        QuadMesh(quads.points, quads.tiles, quads.twins, quads.yellow, np.ones(1, dtype=bool))
