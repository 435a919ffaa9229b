"""The facing walls of two parts along a curve: how far apart they are, at least and along their mid-line."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from fabricate.arrays import Floats
from fabricate.solid.layers import wall
from fabricate.triangles.search_tree import SearchTree

DOWN_WALL = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Where edges and diagonals are measured, from the upper end to the lower one."""


def wall_gaps(left: Sequence[Floats], right: Sequence[Floats]) -> Floats:
    """Return the smallest distance between the facing walls beside each curve point, (c,) float, mm.

    `left` and `right` hold each part's copies of the curve, (c, 3) each, from the outside in. Each wall is measured
    along the edges down it and along the diagonals of its cells, against the other wall's triangles; a diagonal
    counts for the points at both ends of its cell.
    """
    gaps = np.full(len(left[0]), np.inf)
    for own, other in ((left, right), (right, left)):
        tree = _wall_tree(other)
        for upper, lower in itertools.pairwise(own):
            down = [upper + share * (lower - upper) for share in DOWN_WALL]
            across = [upper + share * (np.roll(lower, -1, axis=0) - upper) for share in DOWN_WALL[1:-1]]
            distance = tree.nearest(np.concatenate(down + across)).distance.reshape(-1, len(upper))
            gaps = np.minimum.reduce([gaps, *distance, *np.roll(distance[len(down) :], 1, axis=1)])
    return gaps


def middle_gaps(left: Sequence[Floats], right: Sequence[Floats]) -> Floats:
    """Return the largest distance between the facing walls along their mid-line beside each curve point, (c,) mm.

    `left` and `right` are those of `wall_gaps`. Of walls with a ridge there is a mid-line along each of its rings.
    """
    middles = mid_lines(np.array([left, right]))
    on_left = _wall_tree(left).nearest(middles.reshape(-1, 3)).point
    widest: Floats = _wall_tree(right).nearest(on_left).distance.reshape(-1, len(left[0])).max(axis=0)
    return widest


def mid_lines(walls: Floats) -> Floats:
    """Return the mid-lines, (r, c, 3), between facing walls, (2, l, c, 3): one along each ring between their edges.

    Of walls without rings it is halfway down.
    """
    middles: Floats = walls[:, 1:-1].mean(axis=0) if walls.shape[1] > 2 else walls.mean(axis=(0, 1))[None]
    return middles


def _wall_tree(copies: Sequence[Floats]) -> SearchTree:
    count = len(copies[0])
    cells = [wall(np.arange(count), (k + 1) * count, k * count) for k in range(len(copies) - 1)]
    return SearchTree.of(np.concatenate(copies), np.concatenate(cells))
