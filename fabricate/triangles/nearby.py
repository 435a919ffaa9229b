"""Which triangles come near to others, by their bounding boxes on a grid: a quick first choice for exact tests."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from fabricate.arrays import Floats, Indices, Mask

Counts: TypeAlias = NDArray[np.int32]

FEWEST_CELLS, MOST_CELLS, EDGES = 8, 128, 4.0
"""Bounds of the number of cells along the grid's longest side; within them a cell is about so many edges wide."""


def triangles_near(points: Floats, triangles: Indices, moved: Mask, *, reach: float = 0.0) -> Indices:
    """Return the numbers of all triangles within `reach`, mm, of one with a moved corner, (k,) int; a safe superset.

    The boxes around the moved ones, larger by the reach, cover cells of a grid; a triangle is near when its own box
    has one of these cells.

    Parameters
    ----------
    points : (n, 3) float
        mm.
    triangles : (t, 3) int
    moved : (n,) bool
    """
    near = moved[triangles].any(axis=1)
    if not near.any():
        return np.zeros(0, dtype=np.int64)
    corners = [points[triangles[:, k]] for k in range(3)]
    longest = max(float(np.abs(corners[k] - corners[k - 1]).max()) for k in range(3))
    grid = _Grid.around(points, cells=int(np.clip(np.sqrt(len(triangles)) / EDGES, FEWEST_CELLS, MOST_CELLS)))
    low, high = _box([corner[near] for corner in corners])
    wide = grid.covered(low - reach - longest, high + reach + longest)
    hopeful = np.flatnonzero(grid.within(wide, corners[0]))
    covered = grid.covered(low - reach, high + reach)
    return hopeful[grid.touching(covered, *_box([corner[hopeful] for corner in corners]))]


def _box(corners: Sequence[Floats]) -> tuple[Floats, Floats]:
    """Return the lowest and the highest coordinates of triangles, (t, 3) each, from their corners."""
    return np.minimum.reduce(corners), np.maximum.reduce(corners)


@dataclass(frozen=True, eq=False)
class _Grid:
    """Cells of one size that fill a box: where it begins, their side, mm, and how many there are along each axis."""

    origin: Floats
    side: float
    shape: Indices

    @classmethod
    def around(cls, points: Floats, *, cells: int) -> _Grid:
        origin, end = points.min(axis=0), points.max(axis=0)
        side = max(float((end - origin).max()), float(np.finfo(float).tiny)) / cells
        return cls(origin, side, np.floor((end - origin) / side).astype(np.int64) + 1)

    def covered(self, low: Floats, high: Floats) -> Mask:
        """Return the cells that boxes, (b, 3) each, have a share of."""
        first, last = self._cell(low), self._cell(high) + 1
        steps = np.zeros(self.shape + 1, dtype=np.int32)
        for ends in itertools.product((0, 1), repeat=3):
            corners = np.ravel_multi_index(tuple(np.where(ends, last, first).T), steps.shape)
            np.add.at(steps.reshape(-1), corners, np.int32((-1) ** sum(ends)))
        covered: Mask = _summed(steps)[:-1, :-1, :-1] > 0
        return covered

    def within(self, cells: Mask, places: Floats) -> Mask:
        """Return which places, (k, 3), lie in the cells."""
        found: Mask = cells[tuple(self._cell(places).T)]
        return found

    def touching(self, cells: Mask, low: Floats, high: Floats) -> Mask:
        """Return which boxes, (b, 3) each, have a share of some of the cells."""
        first, last = self._cell(low), self._cell(high) + 1
        sums = np.pad(_summed(cells.astype(np.int32)), ((1, 0), (1, 0), (1, 0)))
        count = np.zeros(len(low), dtype=np.int64)
        for ends in itertools.product((0, 1), repeat=3):
            count += (-1) ** (3 - sum(ends)) * sums[tuple(np.where(ends, last, first).T)]
        return count > 0

    def _cell(self, places: Floats) -> Indices:
        cells = np.floor((places - self.origin) / self.side).astype(np.int64)
        return np.clip(cells, 0, self.shape - 1)


def _summed(values: Counts) -> Counts:
    for axis in range(3):
        values = np.cumsum(values, axis=axis, dtype=np.int32)
    return values
