"""Near distances: exact up to the reach and bounds beyond it, and fewer points are measured."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from fabricate.arrays import Floats
from fabricate.triangles.near_distances import near_distances
from fabricate.triangles.search_tree import Nearest, SearchTree

RANDOM = np.random.default_rng(5).uniform(-3.0, 3.0, (4000, 3))


def sphere_tree() -> SearchTree:
    sphere = trimesh.creation.icosphere(subdivisions=3)
    return SearchTree.of(np.asarray(sphere.vertices), np.asarray(sphere.faces))


@pytest.mark.parametrize("reach", [1e-3, 0.1, 0.5, 2.0, 50.0])
def test_near_points_are_measured_and_no_far_one_is_said_to_be_nearer_than_the_reach(reach: float) -> None:
    tree = sphere_tree()
    always = np.arange(len(RANDOM)) % 7 == 0
    found = near_distances(tree, RANDOM, reach=reach, always=always)
    exact = tree.nearest(RANDOM).distance
    measured = (exact <= reach) | always
    assert (found[measured] == exact[measured]).all()
    assert ((found == exact) | (found == reach)).all()
    assert (found[~measured] >= reach).all()


def test_most_far_points_are_not_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    tree, measured = sphere_tree(), [0]
    nearest = SearchTree.nearest

    def counted(self: SearchTree, queries: Floats) -> Nearest:
        measured[0] += len(queries)
        return nearest(self, queries)

    monkeypatch.setattr(SearchTree, "nearest", counted)
    points = np.concatenate([np.random.default_rng(k).normal(3.0 * k, 0.1, (1000, 3)) for k in range(1, 6)])
    near_distances(tree, points, reach=0.2, always=np.zeros(len(points), dtype=bool))
    assert measured[0] < 0.5 * len(points)


def test_one_point_will_do() -> None:
    found = near_distances(sphere_tree(), np.array([[0.0, 0.0, 5.0]]), reach=1.0, always=np.zeros(1, dtype=bool))
    assert found == pytest.approx(4.0, abs=0.02)
