"""Whether a closed surface crosses itself or folds over: what its points do to it, tested exactly."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from scipy.sparse import csr_array

from fabricate.arrays import Floats, Indices, Mask
from fabricate.triangles.adjacency import neighbour_means
from fabricate.triangles.crossing import crossing_triangles, triangles_near
from fabricate.triangles.normals import area_vectors, unit

Faulty: TypeAlias = Callable[[Floats, Mask], Mask]
"""Tells of points, (n, 3) mm, some of which moved, (n,) bool, at which of them something is wrong, (n,) bool."""

FOLD = -0.9
"""Normals of triangles with a common edge at a smaller cosine, 154 degrees apart, make a fold."""


@dataclass(frozen=True, eq=False)
class Embedding:
    """What of a closed surface does not change when its points move.

    Attributes
    ----------
    triangles : (m, 3) int
        Outward.
    means : (n, n) sparse
        Takes the mean over the points joined to each point.
    sides : (e, 2) int
        The two triangles at each edge.
    """

    triangles: Indices
    means: csr_array
    sides: Indices

    @classmethod
    def of(cls, triangles: Indices, *, count: int) -> Embedding:
        """Find the neighbours of `count` points."""
        ends = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        by_edge = np.argsort(ends[:, 0] * count + ends[:, 1], kind="stable")
        return cls(triangles, neighbour_means(triangles, count=count), (by_edge // 3).reshape(-1, 2))

    def crossed(self, points: Floats, moved: Mask) -> Mask:
        """Return the points, (n,) bool, of triangles that cross one another or have no area.

        Crossings are looked for around the points that `moved`, (n,) bool, only.
        """
        among = self.triangles
        if not moved.all():
            among = among[triangles_near(points, among, moved)]
        wrong: Mask = np.zeros(len(points), dtype=bool)
        wrong[among[crossing_triangles(points, among).ravel()]] = True
        wrong[self.triangles[~area_vectors(points, self.triangles).any(axis=1)]] = True
        return wrong

    def folded(self, points: Floats) -> Mask:
        """Return the edges, (e,) bool, at which the surface doubles back on itself."""
        normals = unit(area_vectors(points, self.triangles))
        first, second = self.sides.T
        sharp: Mask = np.einsum("ij,ij->i", normals[first], normals[second]) < FOLD
        return sharp

    def faults_since(self, old: Floats) -> Faulty:
        """Return the test for crossings, and for folds that the points `old`, (n, 3), do not have: a blade's edge."""
        known = self.folded(old)

        def faulty(points: Floats, moved: Mask) -> Mask:
            wrong = self.crossed(points, moved)
            wrong[self.triangles[self.sides[self.folded(points) & ~known].ravel()]] = True
            return wrong

        return faulty


def stored(points: Floats) -> Floats:
    """Return the points as float32 holds them, which is how files do; what is tested is then what is written."""
    rounded: Floats = points.astype(np.float32).astype(np.float64) + 0.0  # -0.0 becomes 0.0
    return rounded
