from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import named, quad_meshes, seeds
from truchet import any_states, gates, naive_curves, quasi_trees

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.curve import count_curves, next_arcs, traced_arcs
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.errors import PatternError
from fabricate.mesh.sphere import geodesic_sphere

MESHES = quad_meshes()


@given(duotone=quasi_trees())
def test_curve_is_the_one_walked_from_tile_to_tile(duotone: Duotone) -> None:
    sides = gates(duotone.quads)
    traced = [sides[arc // 2][2 * (arc % 2)] for arc in traced_arcs(duotone).tolist()]
    (walked,) = naive_curves(duotone)
    start = walked.index(traced[0])
    assert traced == walked[start:] + walked[:start]


@given(duotone=quasi_trees())
def test_every_tile_is_visited_twice_from_arc_zero_on(duotone: Duotone) -> None:
    order = traced_arcs(duotone)
    assert order[0] == 0
    assert sorted(order.tolist()) == list(range(2 * len(duotone.joined)))


@given(duotone=quasi_trees())
def test_each_arc_is_followed_by_the_next_one_along_the_curve(duotone: Duotone) -> None:
    order = traced_arcs(duotone)
    assert (next_arcs(duotone)[order] == np.roll(order, -1)).all()


@given(duotone=any_states())
def test_count_is_that_of_the_walked_curves(duotone: Duotone) -> None:
    assert count_curves(duotone) == len(naive_curves(duotone))


@given(duotone=any_states())
def test_arcs_are_followed_by_arcs_each_once(duotone: Duotone) -> None:
    assert sorted(next_arcs(duotone).tolist()) == list(range(2 * len(duotone.joined)))


@given(duotone=any_states())
def test_several_curves_are_an_error_that_counts_them(duotone: Duotone) -> None:
    curves = len(naive_curves(duotone))
    if curves == 1:
        assert len(traced_arcs(duotone)) == 2 * len(duotone.joined)
        return
    with pytest.raises(PatternError, match=f"expected one closed curve, found {curves}:"):
        traced_arcs(duotone)


@given(quads=MESHES, seed=seeds)
def test_every_tree_gives_one_curve(quads: QuadMesh, seed: int) -> None:
    assert count_curves(random_duotone(quads, seed=seed)) == 1


@given(quads=MESHES)
def test_without_joined_tiles_each_point_has_a_curve_of_its_own(quads: QuadMesh) -> None:
    nothing, everything = np.zeros(len(quads.tiles), dtype=bool), np.ones(len(quads.tiles), dtype=bool)
    assert count_curves(Duotone(quads, nothing)) == quads.yellow.sum()
    assert count_curves(Duotone(quads, everything)) == (~quads.yellow).sum()


@given(duotone=any_states(), tile=st.integers(0, 10**6))
def test_flipping_a_tile_joins_two_curves_or_splits_one(duotone: Duotone, tile: int) -> None:
    joined = duotone.joined.copy()
    joined[tile % len(joined)] ^= True
    assert abs(count_curves(Duotone(duotone.quads, joined)) - count_curves(duotone)) == 1


@given(duotone=quasi_trees(), pair=st.tuples(st.integers(0, 10**6), st.integers(0, 10**6)))
def test_flipping_two_tiles_keeps_one_curve_exactly_if_their_visits_alternate(
    duotone: Duotone, pair: tuple[int, int]
) -> None:
    first, second = (number % len(duotone.joined) for number in pair)
    visits = [tile for tile in (traced_arcs(duotone) // 2).tolist() if tile in (first, second)]
    alternate = visits[0] != visits[1] and visits[1] != visits[2]
    joined = duotone.joined.copy()
    joined[[first, second]] ^= True
    if first != second:
        assert (count_curves(Duotone(duotone.quads, joined)) == 1) == alternate


@pytest.mark.parametrize("seed", range(5))
def test_yellow_lies_on_the_left(seed: int) -> None:
    quads = subdivided(geodesic_sphere(frequency=3), levels=1)
    duotone = random_duotone(quads, seed=seed)
    arcs = traced_arcs(duotone)
    tile, entry = arcs // 2, 2 * (arcs % 2)
    joined = duotone.joined[tile]
    leave = (entry + np.where(joined, 1, 3)) % 4
    corners = quads.points[quads.tiles]
    middles = (corners + np.roll(corners, -1, axis=1)) / 2
    begin, end = middles[tile, entry], middles[tile, leave]
    left = np.cross(corners.mean(axis=1)[tile], end - begin)
    round_corner = np.where(joined, (entry + 1) % 4, entry)
    aside = corners[tile, round_corner] - (begin + end) / 2
    assert (np.einsum("ij,ij->i", left, aside) > 0).tolist() == (~joined).tolist()
    assert quads.yellow[quads.tiles[tile, round_corner]].tolist() == (~joined).tolist()


@pytest.mark.parametrize("name", named())
def test_each_arc_begins_where_the_one_before_ends(name: str) -> None:
    duotone = random_duotone(subdivided(named()[name], levels=2), seed=1)
    arcs = traced_arcs(duotone)
    tile, entry = arcs // 2, 2 * (arcs % 2)
    leave = (entry + np.where(duotone.joined[tile], 1, 3)) % 4
    corners = duotone.quads.points[duotone.quads.tiles]
    middles = corners + np.roll(corners, -1, axis=1)
    np.testing.assert_array_equal(middles[tile, leave], np.roll(middles[tile, entry], -1, axis=0))
