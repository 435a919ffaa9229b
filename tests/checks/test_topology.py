"""Topology: laws on shapes of known genus, oracles on random voxel solids, every fault caught where it is."""

from __future__ import annotations

from collections import Counter, defaultdict
from itertools import product

import networkx as nx
import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from fabricate.arrays import Indices
from fabricate.checks.check import Check
from fabricate.checks.topology import Edges, Topology, component_labels, topology
from fabricate.solid.part import Part

CODES = ("closed", "oriented", "vertex_manifold", "components", "nondegenerate", "genus")
SIDES = [(axis, side) for axis in range(3) for side in (0, 1)]


def part_of(*meshes: trimesh.Trimesh) -> Part:
    offsets = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    triangles = [mesh.faces + offset for mesh, offset in zip(meshes, offsets, strict=False)]
    return Part("red", np.concatenate([mesh.vertices for mesh in meshes]), np.concatenate(triangles))


def sphere() -> Part:
    return part_of(trimesh.creation.icosphere(subdivisions=2, radius=10))


def check_of(found: Topology, what: str) -> Check:
    return next(check for check in found.checks if check.code == f"red.{what}")


def failed(found: Topology) -> set[str]:
    return {check.code.removeprefix("red.") for check in found.checks if check.failed}


def skipped(found: Topology) -> set[str]:
    return {check.code.removeprefix("red.") for check in found.checks if check.skipped}


def voxels(filled: frozenset[tuple[int, int, int]]) -> Part:
    """Return the boundary of unit cubes, points shared wherever they coincide."""
    quads = [_side(cell, axis, side) for cell in filled for axis, side in SIDES if _open(filled, cell, axis, side)]
    corners = np.array([corner for quad in quads for k in (0, 1, 2, 0, 2, 3) for corner in [quad[k]]])
    points, numbers = np.unique(corners, axis=0, return_inverse=True)
    return Part("red", points, numbers.reshape(-1, 3))


def _open(filled: frozenset[tuple[int, int, int]], cell: tuple[int, int, int], axis: int, side: int) -> bool:
    neighbour = [*cell]
    neighbour[axis] += 2 * side - 1
    return tuple(neighbour) not in filled


def _side(cell: tuple[int, int, int], axis: int, side: int) -> list[tuple[int, int, int]]:
    around = [(0, 0), (1, 0), (1, 1), (0, 1)] if side else [(0, 0), (0, 1), (1, 1), (1, 0)]
    corners = []
    for first, second in around:
        corner = [*cell]
        corner[axis] += side
        corner[(axis + 1) % 3] += first
        corner[(axis + 2) % 3] += second
        corners.append((corner[0], corner[1], corner[2]))
    return corners


cells = st.frozensets(st.sampled_from(list(product(range(3), repeat=3))), min_size=1, max_size=27)


def edge_counts(part: Part) -> Counter[tuple[int, int]]:
    return Counter(
        (min(a, b), max(a, b)) for t in part.triangles.tolist() for a, b in zip(t, t[1:] + t[:1], strict=True)
    )


def fan_counts(part: Part) -> dict[int, int]:
    """Count the fans at each vertex by walking: its triangles, joined where they share an edge of two."""
    users = defaultdict(list)
    around = defaultdict(list)
    for number, t in enumerate(part.triangles.tolist()):
        for a, b in zip(t, t[1:] + t[:1], strict=True):
            users[min(a, b), max(a, b)].append(number)
            around[a].append(number)
    fans = {}
    for vertex, triangles in around.items():
        graph = nx.Graph()
        graph.add_nodes_from(triangles)
        graph.add_edges_from(both for edge, both in users.items() if vertex in edge and len(both) == 2)
        fans[vertex] = nx.number_connected_components(graph)
    return fans


@pytest.mark.parametrize(
    ("mesh", "genus"),
    [
        (trimesh.creation.box((1, 2, 3)), 0),
        (trimesh.creation.icosphere(subdivisions=3), 0),
        (trimesh.creation.torus(10, 3), 1),
        (trimesh.creation.annulus(3, 5, 2), 1),
    ],
)
def test_shapes_of_known_genus_pass(mesh: trimesh.Trimesh, genus: int) -> None:
    found = topology(part_of(mesh), expected_genus=genus)
    assert found.watertight
    assert (found.components, found.genus) == (1, genus)
    assert [check.code for check in found.checks] == [f"red.{code}" for code in CODES]
    assert all(check.ok for check in found.checks)


def test_wrong_genus_fails_and_unknown_genus_is_skipped() -> None:
    ring = part_of(trimesh.creation.torus(10, 3))
    assert failed(topology(ring, expected_genus=0)) == {"genus"}
    assert skipped(topology(ring, expected_genus=None)) == {"genus"}


def test_edges_of_a_box() -> None:
    edges = Edges.of(part_of(trimesh.creation.box()))
    assert len(edges.firsts) == 18  # 12 of the cube and a diagonal per side
    assert (edges.counts == 2).all()
    assert sorted(edges.pairs.ravel()) == list(range(36))
    with pytest.raises(ValueError, match="read-only"):
        edges.order[0] = 1


def test_a_hole_is_found_at_its_edges() -> None:
    whole = sphere()
    found = topology(Part("red", whole.points, whole.triangles[1:]), expected_genus=0)
    assert failed(found) == {"closed"}
    assert skipped(found) == {"genus"}
    assert not found.watertight
    assert found.genus is None
    corners = whole.points[whole.triangles[0]]
    middles = 0.5 * (corners + np.roll(corners, 1, axis=0))
    where = check_of(found, "closed").where
    assert len(where) == 3
    assert np.allclose(sorted(where.tolist()), sorted(middles.tolist()))


def test_a_triangle_too_many_is_found_at_its_edges() -> None:
    whole = sphere()
    found = topology(Part("red", whole.points, np.array([*whole.triangles, whole.triangles[5]])), expected_genus=0)
    assert "closed" in failed(found)
    assert len(check_of(found, "closed").where) == 3
    assert "3 have more than two" in check_of(found, "closed").message


def test_a_flipped_triangle_is_found_at_its_edges() -> None:
    whole = sphere()
    triangles = whole.triangles.copy()
    triangles[7] = triangles[7, ::-1]
    found = topology(Part("red", whole.points, triangles), expected_genus=0)
    assert failed(found) == {"oriented"}
    assert not found.watertight
    centre = whole.points[triangles[7]].mean(axis=0)
    where = check_of(found, "oriented").where
    assert len(where) == 3
    assert np.allclose(where.mean(axis=0), centre)


def test_two_fans_at_a_vertex_are_found_there() -> None:
    one = sphere()
    top = int(one.points[:, 2].argmax())
    other = one.triangles + len(one.points)
    other[other == top + len(one.points)] = top
    mirrored = 2 * one.points[top] - one.points  # touches the first in its top
    found = topology(
        Part("red", np.concatenate([one.points, mirrored]), np.concatenate([one.triangles, other[:, ::-1]])),
        expected_genus=0,
    )
    assert failed(found) == {"vertex_manifold"}
    assert check_of(found, "vertex_manifold").where.tolist() == [one.points[top].tolist()]
    assert found.genus is None


def test_two_components_are_found_in_both() -> None:
    far = trimesh.creation.icosphere(subdivisions=1)
    far.apply_translation((100, 0, 0))
    found = topology(part_of(far, trimesh.creation.box()), expected_genus=0)
    assert failed(found) == {"components"}
    assert found.components == 2
    assert sorted(round(x / 100) for x in check_of(found, "components").where[:, 0]) == [0, 1]
    assert found.genus == 0


@pytest.mark.parametrize("moved_to", [(1.0, 0.0, 0.0), (0.5, 0.0, 0.0)])
def test_triangles_without_area_are_found(moved_to: tuple[float, float, float]) -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], moved_to], dtype=float)
    triangles = [[0, 2, 1], [0, 3, 2], [1, 2, 3], [0, 4, 3], [4, 1, 3], [0, 1, 4]]
    found = topology(Part("red", points, np.array(triangles)), expected_genus=0)
    assert "nondegenerate" in failed(found)
    flat = check_of(found, "nondegenerate")
    assert np.allclose(flat.where[-1], points[[0, 1, 4]].mean(axis=0))


def test_a_repeated_corner_is_found() -> None:
    whole = sphere()
    found = topology(Part("red", whole.points, np.array([*whole.triangles, [3, 3, 3]])), expected_genus=0)
    assert "nondegenerate" in failed(found)
    assert np.allclose(check_of(found, "nondegenerate").where, whole.points[3])


def test_an_empty_part_is_not_closed() -> None:
    found = topology(Part("red", np.zeros((0, 3)), np.zeros((0, 3), dtype=int)), expected_genus=0)
    assert failed(found) == {"closed", "components"}
    assert (found.components, found.genus, found.watertight) == (0, None, False)


def test_points_without_triangles_change_nothing() -> None:
    whole = sphere()
    found = topology(Part("red", np.array([*whole.points, [99.0, 0.0, 0.0]]), whole.triangles), expected_genus=0)
    assert all(check.ok for check in found.checks)


def test_at_most_twenty_places_are_named() -> None:
    whole = sphere()
    assert (
        len(check_of(topology(Part("red", whole.points, whole.triangles[::2]), expected_genus=0), "closed").where) == 20
    )


@given(cells)
def test_voxel_solids_agree_with_slow_walks(filled: frozenset[tuple[int, int, int]]) -> None:
    part = voxels(filled)
    found = topology(part, expected_genus=None)
    counts, fans = edge_counts(part), fan_counts(part)
    assert check_of(found, "closed").ok == all(count == 2 for count in counts.values())
    assert check_of(found, "oriented").ok
    assert check_of(found, "vertex_manifold").ok == all(count == 1 for count in fans.values())
    assert check_of(found, "nondegenerate").ok
    graph = nx.Graph(list(counts))
    assert found.components == nx.number_connected_components(graph)
    if found.genus is not None:
        euler = len(part.points) - len(counts) + len(part.triangles)
        assert euler == 2 * found.components - 2 * found.genus


@given(st.sets(st.integers(0, 319), max_size=30))
def test_flipped_triangles_agree_with_counting(flips: set[int]) -> None:
    whole = sphere()
    triangles: Indices = whole.triangles.copy()
    for number in flips:
        triangles[number] = triangles[number, ::-1]
    part = Part("red", whole.points, triangles)
    directed = Counter((a, b) for t in part.triangles.tolist() for a, b in zip(t, t[1:] + t[:1], strict=True))
    twice = sum(count == 2 for count in directed.values())
    oriented = check_of(topology(part, expected_genus=0), "oriented")
    assert oriented.ok == (twice == 0)
    assert len(oriented.where) == min(twice, 20)


@given(st.permutations(range(12)))
def test_order_of_triangles_does_not_matter(order: list[int]) -> None:
    box = part_of(trimesh.creation.box())
    found = topology(Part("red", box.points, box.triangles[order]), expected_genus=0)
    assert all(check.ok for check in found.checks)


def test_labels_number_the_pieces_from_zero() -> None:
    boxes = [trimesh.creation.box(), trimesh.creation.box(), trimesh.creation.box()]
    part = part_of(*boxes)
    labels = component_labels(part, Edges.of(part))
    assert labels.tolist() == np.repeat([0, 1, 2], 12).tolist()
