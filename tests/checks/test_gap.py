"""The smallest gap: exact against formulas and an independent minimiser, and found where it is."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import nnls
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from fabricate.arrays import Floats
from fabricate.checks.contacts import CORNER_REACH
from fabricate.checks.facts import Gap
from fabricate.checks.gap import Spacing, smallest_gap, widest_gap
from fabricate.checks.geometry import as_manifold
from fabricate.solid.part import Part
from fabricate.triangles.search_tree import SearchTree


def part_of(mesh: trimesh.Trimesh, *, shift: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Part:
    return Part("red", mesh.vertices + np.array(shift), mesh.faces)


def moved(part: Part, shift: tuple[float, float, float]) -> Part:
    return Part(part.name, part.points + np.array(shift), part.triangles)


def tree_of(part: Part) -> SearchTree:
    return SearchTree.of(part.points, part.triangles)


def gap_between(first: Part, second: Part, *, clearance: float | None) -> Gap:
    spacing = Spacing.between(tree_of(first), tree_of(second), clearance=clearance)
    return smallest_gap(spacing, as_manifold(first), as_manifold(second), clearance=clearance)


def turn(angle: float, axis: tuple[int, int, int]) -> Floats:
    matrix = np.eye(4)
    matrix[:3, :3] = Rotation.from_rotvec(angle * np.array(axis)).as_matrix()
    return matrix


def slab(*, cells: int, below: float, top: float) -> trimesh.Trimesh:
    """Return a slab of 1 mm cells from z = below to z = top."""
    mesh: trimesh.Trimesh = trimesh.creation.box((cells, cells, top - below))
    mesh.apply_translation((0, 0, (below + top) / 2))
    while len(mesh.faces) < 12 * cells * cells:
        mesh = mesh.subdivide()
    return mesh


def bumped(mesh: trimesh.Trimesh, *, near: tuple[float, float, float], height: float) -> tuple[Part, Floats]:
    """Raise the vertex nearest to a place, and return the part and where the vertex has come to."""
    points = mesh.vertices.copy()
    bump = int(np.linalg.norm(points - near, axis=1).argmin())
    points[bump, 2] += height
    part = Part("red", points, mesh.faces)
    return part, part.points[bump]


def tetrahedron(corners: Floats) -> Part:
    hull = ConvexHull(corners)
    triangles = hull.simplices.astype(np.int64)
    normals = np.cross(
        corners[triangles[:, 1]] - corners[triangles[:, 0]],
        corners[triangles[:, 2]] - corners[triangles[:, 0]],
    )
    inward = np.einsum("ij,ij->i", normals, hull.equations[:, :3]) < 0
    triangles[inward] = triangles[inward, ::-1]
    return Part("red", corners, triangles)


def hull_distance(first: Floats, second: Floats) -> float:
    """Return the distance between two convex hulls, over the weights of their corners."""
    weigh = 1e4  # so much more do sums of weights count that are not 1
    sums = weigh * np.repeat(np.eye(2), [len(first), len(second)], axis=1)
    span = np.concatenate([first, -second]).T
    weights = nnls(np.concatenate([span, sums]), np.array([0, 0, 0, weigh, weigh]))[0]
    return float(np.linalg.norm(span @ weights))


@pytest.mark.parametrize("clearance", [0.3, 0.25, 0.2, None])
def test_boxes_side_by_side(clearance: float | None) -> None:
    first, second = part_of(trimesh.creation.box()), part_of(trimesh.creation.box(), shift=(1.25, 0, 0))
    gap = gap_between(first, second, clearance=clearance)
    assert gap.min == pytest.approx(0.25, abs=1e-7)
    assert gap.at is not None
    assert gap.at[0] == pytest.approx(0.625)


def test_a_bump_is_found_where_it_is() -> None:
    lower, bump = bumped(slab(cells=16, below=-2, top=0), near=(3.2, -4.1, 0), height=0.12)
    upper = part_of(slab(cells=16, below=0.3, top=2))
    gap = gap_between(lower, upper, clearance=0.3)
    assert gap.min == pytest.approx(0.18, abs=1e-6)
    assert gap.at is not None
    assert np.linalg.norm(bump + np.array([0, 0, 0.09]) - gap.at) < 0.1
    assert gap_between(upper, lower, clearance=0.3).at == pytest.approx(gap.at)


def test_edges_that_cross_in_the_air_are_found_between_their_ends() -> None:
    lower, upper = trimesh.creation.box((40, 2, 2)), trimesh.creation.box((40, 2, 2))
    lower.apply_transform(turn(np.pi / 4, (1, 0, 0)))  # an edge on top, along x
    upper.apply_transform(turn(np.pi / 4, (1, 0, 0)))
    upper.apply_transform(turn(np.pi / 2, (0, 0, 1)))
    first = part_of(lower, shift=(0, 1.7, 0))
    second = part_of(upper, shift=(6.1, 0, 2 * np.sqrt(2) + 0.2))
    gap = gap_between(first, second, clearance=0.3)
    assert gap.min == pytest.approx(0.2, abs=1e-5)
    assert gap.at is not None
    assert np.linalg.norm(np.array(gap.at) - [6.1, 1.7, np.sqrt(2) + 0.1]) < 0.1


def test_a_gap_far_beyond_the_clearance_is_that_of_the_vertices() -> None:
    first, second = part_of(trimesh.creation.box()), part_of(trimesh.creation.box(), shift=(0, 0, 9))
    assert gap_between(first, second, clearance=0.3).min == pytest.approx(8)
    assert gap_between(first, second, clearance=None).min == pytest.approx(8)


def test_overlapping_parts_have_no_gap() -> None:
    mesh = trimesh.creation.icosphere(radius=5)
    gap = gap_between(part_of(mesh), part_of(mesh, shift=(7.3, 0.1, 0.2)), clearance=0.3)
    assert gap.min == 0.0
    assert gap.at is not None
    assert np.linalg.norm(np.array(gap.at) - [3.65, 0, 0]) < 4.0  # somewhere near the lens they share


def test_parts_that_touch_on_purpose_have_no_place() -> None:
    first, second = part_of(trimesh.creation.box()), part_of(trimesh.creation.box(), shift=(1, 0, 0))
    assert gap_between(first, second, clearance=0.0) == Gap(0.0, None)
    apart = gap_between(first, moved(second, (0.1, 0, 0)), clearance=0.0)
    assert apart.min == pytest.approx(0.1, abs=1e-6)
    within = gap_between(first, moved(second, (-0.3, 0.1, 0.2)), clearance=0.0)
    assert within.min == 0.0
    touching = gap_between(first, second, clearance=0.3)
    assert touching.min == 0.0
    assert touching.at is not None


corners: st.SearchStrategy[Floats] = st.lists(
    st.tuples(*3 * [st.integers(-20, 20).map(lambda k: k / 4)]), min_size=4, max_size=4, unique=True
).map(np.array)


@settings(max_examples=60, deadline=None)
@given(corners, corners, st.floats(0.0, 3.0))
def test_tetrahedra_agree_with_a_minimiser(first: Floats, second: Floats, extra: float) -> None:
    volumes = [abs(np.linalg.det(each[1:] - each[0])) for each in (first, second)]
    assume(min(volumes) > 0.5)
    second = second + np.array([0, 0, np.ptp(np.concatenate([first, second])[:, 2]) + 0.1 + extra - 3.0])
    parts = tetrahedron(first), tetrahedron(second)
    expected = hull_distance(parts[0].points, parts[1].points)
    assume(expected > 1e-3)
    gap = gap_between(*parts, clearance=expected)
    assert gap.min == pytest.approx(expected, rel=1e-4)
    assert gap.at is not None
    near = [float(tree_of(part).nearest(np.array([gap.at])).distance[0]) for part in parts]
    assert sum(near) <= 1.02 * expected


def test_vertex_distances_are_measured_both_ways() -> None:
    small, large = part_of(trimesh.creation.box(), shift=(0, 0, 3)), part_of(trimesh.creation.box((9, 9, 2)))
    spacing = Spacing.between(tree_of(small), tree_of(large), clearance=2.0)
    assert spacing.to_second.min() == pytest.approx(1.5)
    assert spacing.to_first.min() > 4.0
    assert gap_between(small, large, clearance=2.0).min == pytest.approx(1.5)


@pytest.mark.parametrize("clearance", [None, 0.0, 3.0])
def test_far_vertices_are_known_to_be_beyond_what_contacts_and_gap_need(clearance: float | None) -> None:
    """Slabs 3 mm apart and 20 mm thick: near walls are measured, and all else lies beyond twice the gap."""
    lower, upper = part_of(slab(cells=8, below=-20, top=0)), part_of(slab(cells=8, below=3, top=20))
    trees = tree_of(lower), tree_of(upper)
    spacing = Spacing.between(*trees, clearance=clearance)
    for own, other, found in ((*trees, spacing.to_second), (*trees[::-1], spacing.to_first)):
        exact = other.nearest(own.points).distance
        measured = found == exact
        assert measured[exact <= CORNER_REACH * max(clearance or 0.0, exact.min())].all()
        assert (found[~measured] > CORNER_REACH * max(clearance or 0.0, exact.min())).all()
        assert (found <= exact).all()
        assert not measured.all()


def test_a_long_edge_between_far_vertices_is_found_near() -> None:
    """A bar across a fine slab's edge: its ends are far from it, and its middle is not."""
    bar = part_of(trimesh.creation.box((40, 1, 1)))
    edge = trimesh.creation.box((1, 1, 1)).subdivide().subdivide()
    edge.apply_transform(turn(np.pi / 4, (1, 0, 0)))
    across = Part("red", edge.vertices + np.array([3, 0, 0.5 + np.sqrt(0.5) + 0.2]), edge.faces)
    assert gap_between(bar, across, clearance=0.3).queried == pytest.approx(0.2, rel=0.01)


def test_the_widest_place_of_a_gap_is_found_from_its_mid_line() -> None:
    lower = part_of(slab(cells=16, below=-2, top=0))
    upper, dent = bumped(slab(cells=16, below=0.3, top=2), near=(3.2, -4.1, 0.3), height=0.2)
    middles = np.column_stack([np.linspace(-7, 7, 701), np.full(701, dent[1]), np.full(701, 0.15)])
    spacing = Spacing.between(tree_of(upper), tree_of(lower), clearance=0.3)
    found = widest_gap(spacing, middles)
    assert found is not None
    assert found[0] == pytest.approx(0.5, abs=0.03)  # to the side of the dent its wall is a little nearer
    assert np.linalg.norm(np.array(found[1]) - [dent[0], dent[1], 0.25]) < 0.1
    assert widest_gap(spacing, middles[:0]) is None


def test_what_distance_queries_find_is_said_beside_the_gap() -> None:
    first, second = part_of(trimesh.creation.box()), part_of(trimesh.creation.box(), shift=(1.25, 0, 0))
    assert gap_between(first, second, clearance=0.3).queried == pytest.approx(0.25, abs=1e-6)
    assert gap_between(first, moved(second, (3.0, 0, 0)), clearance=0.3).queried == pytest.approx(3.25, abs=1e-6)
