"""Crossing triangles of meshes in any state, without a flood of pairs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.triangles.crossing import crossing_triangles

MOST_PAIRS = 2_000_000
"""More pairs of triangles with overlapping boxes than this are not all tried: each one found takes 200 bytes."""

_PROBES = 256


class Crossings(NamedTuple):
    """Pairs of triangles that cross or overlap, (k, 2) int, and whether these are all."""

    pairs: Indices
    complete: bool


def crossings(points: Floats, triangles: Indices) -> Crossings:
    """Return the crossing pairs, of very tangled triangles only those among every second, third ... one.

    Few real surfaces are tangled so; of a soup of thousands of large triangles almost every pair crosses.
    """
    if not len(triangles):
        return Crossings(np.zeros((0, 2), dtype=np.int64), complete=True)
    expected = _box_pairs(points, triangles)
    step = int(np.ceil(np.sqrt(expected / MOST_PAIRS))) if expected > MOST_PAIRS else 1
    return Crossings(step * crossing_triangles(points, triangles[::step]), complete=step == 1)


def _box_pairs(points: Floats, triangles: Indices) -> float:
    """Return about how many pairs of triangles have bounding boxes that overlap, from evenly chosen ones."""
    corners = points[triangles]
    low, high = corners.min(axis=1), corners.max(axis=1)
    chosen = np.unique(np.linspace(0, len(triangles) - 1, _PROBES).astype(np.int64))
    met = [int(((low <= high[number]) & (high >= low[number])).all(axis=1).sum()) - 1 for number in chosen]
    return float(np.mean(met)) * len(triangles) / 2
