"""The facing walls of two parts along a curve: how far apart they are, at least and along their mid-line."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.solid.layers import wall
from fabricate.triangles.search_tree import SearchTree

DOWN_WALL = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Where edges and diagonals are measured, from the upper end to the lower one."""


@dataclass(frozen=True, eq=False)
class WallGaps:
    """The facing walls of two parts as they were measured.

    Each wall is measured along the edges down it and along the diagonals of its cells, against the other wall's
    triangles; a diagonal counts for the points at both ends of its cell.

    Attributes
    ----------
    left, right : tuple of (c, 3) float
        Each part's copies of the curve, from the outside in, mm.
    gaps : (c,) float
        The smallest distance between the walls beside each curve point, mm.
    cells : (c,) int
        The cell of the other wall that it leads to, by the curve point where the cell begins.
    """

    left: tuple[Floats, ...]
    right: tuple[Floats, ...]
    gaps: Floats
    cells: Indices

    @classmethod
    def of(cls, left: Sequence[Floats], right: Sequence[Floats]) -> WallGaps:
        """Measure walls everywhere."""
        return cls(tuple(left), tuple(right), *_gaps_at(left, right, np.arange(len(left[0]))))

    def again(self, left: Sequence[Floats], right: Sequence[Floats]) -> WallGaps:
        """Measure the same walls after some of their points have moved: beside these, and where the gap led to them.

        What has come nearer is found beside the points that moved, whichever wall they are on.
        """
        olds, news = (*self.left, *self.right), (*left, *right)
        moved = np.logical_or.reduce([(old != new).any(axis=1) for old, new in zip(olds, news, strict=True)])
        if not moved.any():
            return self
        cells = moved | np.roll(moved, -1)
        numbers = np.flatnonzero(cells | np.roll(cells, 1) | cells[self.cells])
        gaps, nearest = self.gaps.copy(), self.cells.copy()
        gaps[numbers], nearest[numbers] = _gaps_at(left, right, numbers)
        return WallGaps(tuple(left), tuple(right), gaps, nearest)


def _gaps_at(left: Sequence[Floats], right: Sequence[Floats], numbers: Indices) -> tuple[Floats, Indices]:
    """Return the smallest distances between facing walls beside some curve points, (k,) int, and cells they lead to."""
    count = len(left[0])
    cells = np.unique(np.concatenate([numbers, (numbers - 1) % count]))
    gaps, nearest = np.full(count, np.inf), np.zeros(count, dtype=np.int64)
    for own, other in ((left, right), (right, left)):
        tree = _wall_tree(other)
        for upper, lower in itertools.pairwise(own):
            begins, ends, across_ends = upper[cells], lower[cells], lower[(cells + 1) % count]
            down = [begins + share * (ends - begins) for share in DOWN_WALL]
            across = [begins + share * (across_ends - begins) for share in DOWN_WALL[1:-1]]
            found = tree.nearest(np.concatenate(down + across))
            distance, cell = (each.reshape(-1, len(cells)) for each in (found.distance, found.triangle % count))
            for beside, first in ((cells, 0), ((cells + 1) % count, len(down))):
                best = distance[first:].argmin(axis=0)
                least = distance[first:][best, np.arange(len(cells))]
                nearer = least < gaps[beside]
                gaps[beside[nearer]] = least[nearer]
                nearest[beside[nearer]] = cell[first:][best, np.arange(len(cells))][nearer]
    return gaps[numbers], nearest[numbers]


def middle_gaps(left: Sequence[Floats], right: Sequence[Floats]) -> Floats:
    """Return the largest distance between the facing walls along their mid-line beside each curve point, (c,) mm.

    `left` and `right` hold each part's copies of the curve, (c, 3) each, from the outside in. Of walls with a ridge
    there is a mid-line along each of its rings.
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
