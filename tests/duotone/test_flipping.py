"""Flips of interlaced tiles: one curve after any number of them, without tracing it again; other pairs are refused."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import HANDLES, quad_meshes, seeds
from truchet import any_states, quasi_trees

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.certificate import certified
from fabricate.duotone.curve import count_curves, traced_arcs
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.flipping import FlippingCurve, flipped
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.errors import PatternError


def alternate(duotone: Duotone, first: int, second: int) -> bool:
    """Whether the visits of two tiles alternate, read from the traced curve."""
    visits = [tile for tile in (traced_arcs(duotone) // 2).tolist() if tile in (first, second)]
    return visits[0] != visits[1] and visits[1] != visits[2]


def assert_as_traced(curve: FlippingCurve) -> None:
    """Assert that the order carried along is that of the curve traced anew, from arc 0 on."""
    start = int(np.flatnonzero(curve.order == 0)[0])
    assert np.array_equal(np.roll(curve.order, -start), traced_arcs(curve.duotone))


def wander(curve: FlippingCurve, rng: np.random.Generator, flips: int) -> list[tuple[bool, bool]]:
    """Make any legal flips, and return the states that the tiles had before."""
    made: list[tuple[bool, bool]] = []
    while len(made) < flips:
        first = int(rng.integers(len(curve.joined)))
        partners = curve.partners(first)
        if len(partners):
            second = int(rng.choice(partners))
            made.append((bool(curve.joined[first]), bool(curve.joined[second])))
            curve.flip(first, second)
    return made


@settings(max_examples=15)
@given(quads=quad_meshes(), seed=seeds)
def test_a_thousand_legal_flips_leave_a_duotone_with_the_handles_that_they_moved(quads: QuadMesh, seed: int) -> None:
    curve = FlippingCurve(random_duotone(quads, seed=seed))
    made = wander(curve, np.random.default_rng(seed), 1000)
    found = certified(curve.duotone)
    assert found.curves == 1
    assert found.yellow.components == found.blue.components == 1
    moved = sum(first == second and (-1) ** first for first, second in made)
    assert found.yellow.handles == moved
    assert found.yellow.euler_characteristic == 1 - 2 * moved
    assert found.blue.euler_characteristic == 1 - 2 * (quads.genus - moved)
    assert_as_traced(curve)


@given(duotone=quasi_trees(), seed=seeds, flips=st.integers(1, 5))
def test_the_order_is_that_of_the_curve_traced_anew(duotone: Duotone, seed: int, flips: int) -> None:
    curve = FlippingCurve(duotone)
    if any(len(curve.partners(tile)) for tile in range(len(duotone.joined))):
        wander(curve, np.random.default_rng(seed), flips)
    assert_as_traced(curve)


@given(duotone=quasi_trees(), pair=st.tuples(st.integers(0, 10**6), st.integers(0, 10**6)))
def test_pairs_that_alternate_are_flipped_and_others_refused(duotone: Duotone, pair: tuple[int, int]) -> None:
    first, second = (number % len(duotone.joined) for number in pair)
    if first == second:
        return
    if alternate(duotone, first, second):
        found = flipped(duotone, first, second)
        assert np.flatnonzero(found.joined != duotone.joined).tolist() == sorted([first, second])
        assert count_curves(found) == 1
    else:
        with pytest.raises(PatternError, match=f"tiles {first} and {second} are not interlaced"):
            flipped(duotone, first, second)


@given(duotone=quasi_trees(), tile=st.integers(0, 10**6))
def test_partners_are_all_tiles_that_alternate(duotone: Duotone, tile: int) -> None:
    first = tile % len(duotone.joined)
    curve = FlippingCurve(duotone)
    others = [second for second in range(len(duotone.joined)) if second != first]
    expected = [second for second in others if alternate(duotone, first, second)]
    assert sorted(curve.partners(first).tolist()) == expected
    assert [second for second in others if curve.interlaced(first, second)] == expected


@given(duotone=quasi_trees(), share=st.floats(0, 1), seed=seeds)
def test_interlaced_within_a_set_are_those_with_a_partner_in_it(duotone: Duotone, share: float, seed: int) -> None:
    curve = FlippingCurve(duotone)
    tiles = np.random.default_rng(seed).random(len(duotone.joined)) < share
    expected = [bool(own and tiles[curve.partners(tile)].any()) for tile, own in enumerate(tiles.tolist())]
    assert curve.interlaced_among(tiles).tolist() == expected


def test_flipping_a_pair_twice_gives_the_duotone_back() -> None:
    duotone = random_duotone(subdivided(HANDLES["double torus"][0], levels=1), seed=3)
    curve = FlippingCurve(duotone)
    second = int(curve.partners(5)[0])
    curve.flip(5, second)
    curve.flip(second, 5)
    assert np.array_equal(curve.joined, duotone.joined)
    assert_as_traced(curve)


@pytest.mark.parametrize("pair", [(4, 4), (-1, 3), (3, 10**6)])
def test_what_is_not_two_tiles_is_refused(pair: tuple[int, int]) -> None:
    duotone = random_duotone(subdivided(HANDLES["torus"][0], levels=1), seed=3)
    with pytest.raises(PatternError, match="expected two tiles from 0 to 59, found"):
        flipped(duotone, *pair)


def test_a_refused_flip_changes_nothing() -> None:
    duotone = random_duotone(subdivided(HANDLES["torus"][0], levels=1), seed=3)
    curve = FlippingCurve(duotone)
    stranger = next(tile for tile in range(1, 60) if not curve.interlaced(0, tile))
    before = curve.order.copy()
    with pytest.raises(PatternError):
        curve.flip(0, stranger)
    assert np.array_equal(curve.order, before)
    assert np.array_equal(curve.joined, duotone.joined)


@given(duotone=any_states())
def test_several_curves_cannot_be_flipped(duotone: Duotone) -> None:
    if count_curves(duotone) > 1:
        with pytest.raises(PatternError, match="expected one closed curve"):
            FlippingCurve(duotone)


def test_what_it_shows_cannot_be_written_to() -> None:
    curve = FlippingCurve(random_duotone(subdivided(HANDLES["torus"][0], levels=1), seed=3))
    for array in (curve.joined, curve.order):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = array[1]
