"""The floor of a solid core: a copy of the inlaid part's inner surface, deeper by the clearance.

A copy moved straight down by the clearance is nearer than that wherever the surface bends, and because the two copies
of the curve have moved to different sides, its facets do not match those above. So it is measured, and lowered where
it is too near; the core has room enough.
"""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.triangles.normals import area_vectors, unit
from fabricate.triangles.search_tree import SearchTree

LEAST_COSINE = 0.5
"""Smallest cosine at folds of the inner surface that is made up for under it."""

MOST_LOWERED = 1.5
"""By which factor a floor is lowered at most at a time."""


def floor_drop(points: Floats, triangles: Indices, down: Floats, *, clearance: float) -> Floats:
    """Return how far along `down`, (n, 3) unit vectors, a floor lies below the inner points, (n,) float, mm.

    A copy moved by a distance over the smallest cosine between the way down and the triangles' own way down
    keeps at least that distance from each of the point's triangles.
    """
    facets = unit(area_vectors(points, triangles))
    steepest: Floats = np.ones(len(points))
    for k in range(3):
        corner = triangles[:, k]
        np.minimum.at(steepest, corner, -np.einsum("ij,ij->i", facets, down[corner]))
    return clearance / np.maximum(steepest, LEAST_COSINE)


def lowered(drop: Floats, ceiling: Floats, floor: Floats, triangles: Indices, *, clearance: float) -> Floats:
    """Return the drop, (n,) mm, made larger where the floor is nearer to the ceiling than the clearance.

    `ceiling` and `floor`, (n, 3), are the inlaid part's inner surface and the floor under it, `triangles` those of
    the inlaid part's region. Both are measured at their points and at the middles of their edges.
    """
    gaps = np.full(len(drop), np.inf)
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    for own, other in ((ceiling, floor), (floor, ceiling)):
        tree = SearchTree.of(other, triangles)
        at_middle = tree.nearest(own[edges].mean(axis=1)).distance
        for end in (0, 1):
            at_end = tree.nearest(own[edges[:, end]]).distance
            np.minimum.at(gaps, edges[:, end], np.minimum(at_middle, at_end))
    factor = np.clip(clearance / np.maximum(gaps, 1e-9), 1.0, MOST_LOWERED)
    spread: Floats = factor.copy()
    for first, second in ((0, 1), (1, 0)):
        np.maximum.at(spread, edges[:, first], factor[edges[:, second]])
    return drop * spread
