"""Handles: every division between the regions can be had, each move flips two tiles, and the sum is the genus."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from polyhedra import HANDLES, quad_meshes, seeds
from truchet import quasi_trees

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.certificate import certified
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.handles import checked_handles, with_handles, yellow_handles
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.spanning_tree import Tree, grown_duotone, random_duotone
from fabricate.errors import PatternError
from fabricate.mesh.sphere import geodesic_sphere

EIGHT = random_duotone(subdivided(HANDLES["double torus"][0], levels=2), seed=4)


@pytest.mark.parametrize("tree", ["random", "breadth-first", "depth-first"])
@pytest.mark.parametrize("name", HANDLES)
def test_every_division_of_the_genus_can_be_had(name: str, tree: Tree) -> None:
    mesh, genus = HANDLES[name]
    duotone = grown_duotone(subdivided(mesh, levels=1), tree=tree, seed=5)
    for yellow in range(genus + 1):
        found = with_handles(duotone, yellow=yellow, seed=5)
        proof = certified(found)
        assert proof.holds
        assert (proof.yellow.handles, proof.blue.handles) == (yellow, genus - yellow)
        assert np.count_nonzero(found.joined != duotone.joined) == 2 * yellow


@settings(max_examples=40)
@given(duotone=quasi_trees(), seed=seeds)
def test_handles_move_either_way_from_any_single_curve(duotone: Duotone, seed: int) -> None:
    yellow = seed % (duotone.quads.genus + 1)
    proof = certified(with_handles(duotone, yellow=yellow, seed=seed))
    assert proof.holds
    assert proof.yellow.handles == yellow


@given(duotone=quasi_trees())
def test_handles_are_those_of_the_certificate(duotone: Duotone) -> None:
    assert yellow_handles(duotone) == certified(duotone).yellow.handles


@given(quads=quad_meshes(), seed=seeds)
def test_nothing_changes_where_handles_are_as_asked(quads: QuadMesh, seed: int) -> None:
    duotone = random_duotone(quads, seed=seed)
    assert np.array_equal(with_handles(duotone, yellow=0, seed=seed).joined, duotone.joined)


def test_seeds_differ_and_repeat() -> None:
    first, again, other = (with_handles(EIGHT, yellow=2, seed=seed).joined for seed in (1, 1, 2))
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def test_the_least_reluctant_tiles_are_flipped() -> None:
    reluctance = np.random.default_rng(0).integers(0, 50, size=len(EIGHT.joined))
    willing, unwilling = (with_handles(EIGHT, yellow=2, seed=1, reluctance=each) for each in (reluctance, -reluctance))
    sums = [reluctance[each.joined != EIGHT.joined].sum() for each in (willing, unwilling)]
    assert sums[0] < 0.5 * sums[1]
    back = with_handles(willing, yellow=1, seed=1, reluctance=reluctance)
    shy = with_handles(willing, yellow=1, seed=1, reluctance=-reluctance)
    assert reluctance[back.joined != willing.joined].sum() > reluctance[shy.joined != willing.joined].sum()


def test_locked_tiles_stay() -> None:
    free = np.random.default_rng(3).random(len(EIGHT.joined)) < 0.5
    found = with_handles(EIGHT, yellow=2, seed=1, free=free)
    assert certified(found).yellow.handles == 2
    assert np.array_equal(found.joined[~free], EIGHT.joined[~free])


def test_too_many_locks_are_an_error() -> None:
    with pytest.raises(PatternError, match="expected 1, but locked tiles keep it at 0"):
        with_handles(EIGHT, yellow=1, seed=1, free=np.zeros(len(EIGHT.joined), dtype=bool))


@pytest.mark.parametrize("yellow", [-1, 3])
def test_out_of_range_names_the_genus(yellow: int) -> None:
    with pytest.raises(PatternError, match=f"genus 2, so yellow can have 0 to 2 handles, found {yellow}"):
        with_handles(EIGHT, yellow=yellow, seed=1)


def test_a_sphere_has_no_handle_to_give() -> None:
    sphere = random_duotone(subdivided(geodesic_sphere(frequency=2), levels=1), seed=1)
    with pytest.raises(PatternError, match="genus 0, so yellow can have no handle, found 1"):
        with_handles(sphere, yellow=1, seed=1)
    assert checked_handles(0, 0) == 0
