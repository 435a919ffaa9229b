"""Words on edges: they cancel round every triangle, and along a closed way exactly when it parts the surface."""

from __future__ import annotations

import numpy as np
import pytest
from polyhedra import HANDLES

from fabricate.arrays import Indices, Words
from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus
from fabricate.prepare.homology import edge_words
from fabricate.prepare.triangle_mesh import TriangleMesh, edges, fanned

AROUND, ACROSS = 12, 6
RING = fanned(torus(around=AROUND, across=ACROSS, tube=0.4))


def word_along(surface: TriangleMesh, way: Indices) -> Words:
    """Return the exclusive or of the words along a closed way of points."""
    joined, words = edges(surface), edge_words(surface)
    number = {tuple(ends): k for k, ends in enumerate(joined.ends.tolist())}
    sides = zip(way.tolist(), np.roll(way, -1).tolist(), strict=True)
    return np.bitwise_xor.reduce(words[[number[min(a, b), max(a, b)] for a, b in sides]], axis=0)


def circle(axis: int, step: int) -> Indices:
    """Return the corners of quads along one of the ring's circles: of the tube, or round the axis."""
    numbers = np.arange(AROUND * ACROSS).reshape(AROUND, ACROSS)
    return numbers[step] if axis == 0 else numbers[:, step]


@pytest.mark.parametrize("name", HANDLES)
def test_words_cancel_round_every_triangle(name: str) -> None:
    surface = fanned(HANDLES[name][0])
    words = edge_words(surface)
    assert not np.bitwise_xor.reduce(words[edges(surface).of_triangle], axis=1).any()


@pytest.mark.parametrize("name", HANDLES)
def test_as_many_words_are_independent_as_two_per_handle(name: str) -> None:
    mesh, handles = HANDLES[name]
    words = edge_words(fanned(mesh)).view(np.uint8)
    bits = np.unpackbits(words.reshape(-1, 32), axis=1)
    assert rank_of_two(bits) == 2 * handles


def rank_of_two(bits: np.ndarray) -> int:
    """Return the rank of a matrix of zeros and ones over Z2, by elimination."""
    rows, rank = bits.copy(), 0
    for column in range(rows.shape[1]):
        pivots = np.flatnonzero(rows[rank:, column]) + rank
        if not len(pivots):
            continue
        rows[[rank, pivots[0]]] = rows[[pivots[0], rank]]
        others = np.flatnonzero(rows[:, column])
        rows[others[others != rank]] ^= rows[rank]
        rank += 1
    return rank


def test_a_ball_has_no_words() -> None:
    assert not edge_words(fanned(sphere(faces="triangles", frequency=3))).any()


def test_circles_of_a_ring_have_words_and_parallel_ones_the_same() -> None:
    tube, other_tube = (word_along(RING, circle(0, step)) for step in (0, 5))
    ring, other_ring = (word_along(RING, circle(1, step)) for step in (0, 3))
    assert tube.any()
    assert ring.any()
    np.testing.assert_array_equal(tube, other_tube)
    np.testing.assert_array_equal(ring, other_ring)
    assert (tube != ring).any()
