from __future__ import annotations

import numpy as np
import pytest
from breaking import box, triangles, united
from hypothesis import given, settings
from polyhedra import polyhedra

from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare import crossing_pairs
from fabricate.prepare.crossing_pairs import crossings
from fabricate.prepare.ear_clipping import ear_clipped
from fabricate.triangles.crossing import crossing_triangles


def pairs(numbers: np.ndarray) -> set[frozenset[int]]:
    return {frozenset(pair) for pair in numbers.tolist()}


@settings(max_examples=20)
@given(polyhedra(), polyhedra())
def test_all_pairs_of_two_bodies_in_each_other_are_found(first: PolygonMesh, second: PolygonMesh) -> None:
    both = united(first, second.moved(second.points + np.array([0.3, 0.2, 0.1])))
    cut = ear_clipped(both).triangles
    found = crossings(both.points, cut)
    assert found.complete
    assert pairs(found.pairs) == pairs(crossing_triangles(both.points, cut))


def test_of_a_tangle_some_pairs_are_found_and_it_is_said_so(monkeypatch: pytest.MonkeyPatch) -> None:
    points = np.random.default_rng(0).random((300, 3))
    cut = np.arange(300).reshape(-1, 3)
    every = pairs(crossings(points, cut).pairs)
    monkeypatch.setattr(crossing_pairs, "MOST_PAIRS", 100)
    found = crossings(points, cut)
    assert not found.complete
    assert pairs(found.pairs) < every
    assert len(found.pairs) > 0


def test_a_cube_and_nothing_have_no_crossings() -> None:
    assert crossings(box().points, triangles(box())).complete
    for cut in (triangles(box()), np.zeros((0, 3), dtype=np.int64)):
        assert len(crossings(box().points, cut).pairs) == 0
