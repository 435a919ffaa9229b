"""Unfolding: on a rough surface fewer triangles of the copies turn over, and elsewhere nothing changes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.torus import torus
from fabricate.solid.clearance import FARTHEST, Shares
from fabricate.solid.layers import layer, layer_shares
from fabricate.solid.settling import fitted_cut
from fabricate.solid.unfolding import unfolded
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled
from fabricate.triangles.normals import area_vectors


@pytest.fixture(scope="module", params=[(0.5,), (0.4, 0.6)], ids=["one curve", "two curves"])
def surface(request: pytest.FixtureRequest) -> CutSurface:
    quads = tiled(sized(torus(around=8, across=4, tube=0.45), size=60), tile_size=12)
    return fitted_cut(grown_duotone(quads, tree="random", seed=3), rings=request.param, tolerance=0.3)


def turned(surface: CutSurface, points: np.ndarray, shares: Sequence[Shares]) -> int:
    """Return how many triangles face the other way in their region's copy."""
    before, count = area_vectors(points, surface.triangles), 0
    for region, copy in enumerate(layer(surface, points, shares).copies):
        after = area_vectors(copy, surface.triangles)
        count += int(((surface.regions == region) & (np.einsum("ij,ij->i", before, after) < 0.0)).sum())
    return count


def test_uneven_moves_over_ridges_are_made_up_for(surface: CutSurface) -> None:
    chance = np.random.default_rng(0)
    rough = surface.points + 0.4 * chance.standard_normal((len(surface.points), 1)) * surface.normals
    shares = [Shares(*chance.uniform(0.0, 0.9, (2, len(curve)))) for curve in surface.curves]
    before, eased = turned(surface, rough, shares), unfolded(surface, rough, shares)
    assert before > 20
    assert turned(surface, rough, eased) < 0.5 * before
    for own, old in zip(eased, shares, strict=True):
        assert min(own.left.min(), own.right.min()) >= 0.0
        assert max(own.left.max(), own.right.max()) <= FARTHEST
        less, more = own.left < old.left, own.right > old.right
        assert (more | (own.right == FARTHEST) | (own.right < old.right))[less].all()


def test_where_nothing_turns_over_nothing_changes(surface: CutSurface) -> None:
    wanted = np.full(surface.curves.shape, 0.3)
    shares = layer_shares(surface, surface.points, -surface.normals, clearance=wanted)
    assert turned(surface, surface.points, shares) == 0
    for own, old in zip(unfolded(surface, surface.points, shares), shares, strict=True):
        assert (own.left == old.left).all()
        assert (own.right == old.right).all()
