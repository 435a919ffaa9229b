"""Wide trees: tiles are joined where their necks are wide, as far as one curve allows, and still at random."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fabricate.design.wide_tree import wide_duotone
from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.certificate import certified
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.spanning_tree import Tree, grown_duotone
from fabricate.mesh.torus import torus
from fabricate.surface.neck import NeckGauge, coarse_necks
from fabricate.surface.sizing import sized


def slanted_torus() -> QuadMesh:
    """A torus whose tiles lean in one half of it, so that one diagonal is short there."""
    quads = subdivided(sized(torus(around=16, across=8, tube=0.45), size=60), levels=1)
    x, y, z = quads.points.T
    turn = 0.25 * np.sin(np.arctan2(z, np.hypot(x, y) - 20.0)) * (x > 0)
    points = np.stack([x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn), z], axis=1)
    return replace(quads, points=points)


QUADS = slanted_torus()
NECKS = NeckGauge.of(QUADS, rings=(0.5,)).necks(QUADS.points)
NECK = float(np.quantile(NECKS.min(axis=1), 0.4))


def narrow(tree: Tree, seed: int) -> int:
    found = wide_duotone(QUADS, tree=tree, seed=seed, rings=(0.5,), neck=NECK)
    return int(np.count_nonzero(coarse_necks(found, rings=(0.5,)) < NECK))


@given(seed=st.integers(0, 999))
@settings(max_examples=20)
def test_fewer_necks_are_narrow_than_in_any_tree(seed: int) -> None:
    plain = grown_duotone(QUADS, tree="random", seed=seed)
    hopeless = int(np.count_nonzero(NECKS.max(axis=1) < NECK))
    without = int(np.count_nonzero(coarse_necks(plain, rings=(0.5,)) < NECK))
    assert without > hopeless + 10
    assert hopeless <= narrow("random", seed) < hopeless + 0.5 * (without - hopeless)


@given(seed=st.integers(0, 999))
@settings(max_examples=20)
def test_it_is_one_curve_still(seed: int) -> None:
    certified(wide_duotone(QUADS, tree="random", seed=seed, rings=(0.5,), neck=NECK))


def test_seeds_still_differ() -> None:
    first, second = (wide_duotone(QUADS, tree="random", seed=seed, rings=(0.5,), neck=NECK) for seed in (1, 2))
    assert (first.joined != second.joined).mean() > 0.1


def test_roomy_tiles_give_the_tree_of_the_seed() -> None:
    roomy = wide_duotone(QUADS, tree="random", seed=5, rings=(0.5,), neck=0.9 * float(NECKS.min()))
    assert (roomy.joined == grown_duotone(QUADS, tree="random", seed=5).joined).all()


@pytest.mark.parametrize("tree", ["uniform", "breadth-first", "depth-first"])
def test_other_trees_keep_their_shape(tree: Tree) -> None:
    found = wide_duotone(QUADS, tree=tree, seed=3, rings=(0.5,), neck=NECK)
    assert (found.joined == grown_duotone(QUADS, tree=tree, seed=3).joined).all()
