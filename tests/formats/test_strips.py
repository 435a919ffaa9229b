"""Strips and fans: the triangles are those of a slow walk, all wound like the first."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fabricate.formats.strips import fan_triangles, strip_triangles

POINTS = st.lists(st.integers(0, 6), max_size=9)


def distinct(triangles: list[list[int]]) -> list[list[int]]:
    return [triangle for triangle in triangles if len(set(triangle)) == 3]


def walked_strip(strip: list[int]) -> list[list[int]]:
    triangles, flipped = [], False
    for a, b, c in zip(strip, strip[1:], strip[2:], strict=False):
        triangles.append([b, a, c] if flipped else [a, b, c])
        flipped = not flipped
    return distinct(triangles)


@given(st.lists(POINTS, max_size=5))
def test_strips_are_walked_each_by_itself(strips: list[list[int]]) -> None:
    joined = [point for strip in strips for point in [*strip, -1]][:-1]
    triangles = strip_triangles(np.array(joined, dtype=np.int64))
    assert triangles.tolist() == [triangle for strip in strips for triangle in walked_strip(strip)]


@given(POINTS)
def test_fans_turn_round_their_first_point(fan: list[int]) -> None:
    triangles = fan_triangles(np.array(fan, dtype=np.int64))
    assert triangles.tolist() == distinct([[fan[0], b, c] for b, c in pairwise(fan[1:])])


def test_neighbours_in_a_strip_run_along_their_common_edge_in_opposite_directions() -> None:
    triangles = strip_triangles(np.arange(6))
    edges = [(t[k], t[(k + 1) % 3]) for t in triangles.tolist() for k in range(3)]
    assert len(set(edges)) == len(edges)
    assert sum((b, a) in edges for a, b in edges) == 2 * (len(triangles) - 1)
