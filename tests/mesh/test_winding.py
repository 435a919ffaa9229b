from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import face_lists, surfaces, tetrahedron

from fabricate.mesh.closed import signed_volume
from fabricate.mesh.edges import Edges, InnerEdges, sheets
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.winding import fewest_flips, flipped

choices = st.sets(st.integers(0, 100))


def mask(mesh: PolygonMesh, which: set[int]) -> np.ndarray:
    return np.isin(np.arange(len(mesh.offsets) - 1), list(which))


@given(surfaces(), choices)
def test_flipped_faces_run_backwards_from_the_same_corner_and_flip_back(mesh: PolygonMesh, which: set[int]) -> None:
    other = flipped(mesh, mask(mesh, which))
    for n, (before, after) in enumerate(zip(face_lists(mesh), face_lists(other), strict=True)):
        assert after == ([before[0], *before[:0:-1]] if n in which else before)
    assert (flipped(other, mask(mesh, which)).corners == mesh.corners).all()


@given(surfaces(), choices)
def test_the_fewest_flips_make_all_faces_agree(mesh: PolygonMesh, which: set[int]) -> None:
    wrong = mask(mesh, which)
    mixed = flipped(mesh, wrong)
    flips = fewest_flips(sheets(mixed, InnerEdges.of(mixed, Edges.of(mixed))))
    assert flips.sum() == min(wrong.sum(), (~wrong).sum())
    whole = flipped(mixed, flips)
    assert InnerEdges.of(whole, Edges.of(whole)).agree.all()
    assert np.isclose(abs(signed_volume(whole)), signed_volume(mesh))


def test_sharp_edges_stay_on_their_edges() -> None:
    mesh = tetrahedron()
    ends = np.sort(np.column_stack([mesh.corners, mesh.corners[mesh.next_corner]]), axis=1)
    sharp = (ends == [0, 1]).all(axis=1)
    creased = PolygonMesh(mesh.points, mesh.corners, mesh.offsets, sharp)
    other = flipped(creased, np.array([True, False, True, True]))
    marked = [
        {a, b}
        for face, begin in zip(face_lists(other), other.offsets, strict=False)
        for (a, b), crease in zip(pairwise([*face, face[0]]), other.creases[begin : begin + 3], strict=True)
        if crease
    ]
    assert marked == [{0, 1}, {0, 1}]


def test_a_moebius_strip_is_left_alone() -> None:
    strip = [(i, i + 1, i + 6, i + 5) for i in range(4)] + [(4, 5, 0, 9)]
    mesh = PolygonMesh.from_faces(np.random.default_rng(1).random((10, 3)), strip)
    assert not fewest_flips(sheets(mesh, InnerEdges.of(mesh, Edges.of(mesh)))).any()
