"""Whether a closed surface crosses itself or folds over: what its points do to it, tested exactly."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from scipy.sparse import csr_array

from fabricate.arrays import Floats, Indices, Mask
from fabricate.triangles.adjacency import grown, neighbour_means
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.nearby import triangles_near
from fabricate.triangles.normals import area_vectors, mean_normals, unit

Faulty: TypeAlias = Callable[[Floats, Mask], Mask]
"""Tells of points, (n, 3) mm, some of which moved, (n,) bool, at which of them something is wrong, (n,) bool."""

OPEN = 0.2
"""Where a triangle at a point is steeper than this cosine against the point's normal the surface folds: hardly a way
leads into the body through all triangles there. The edge of a wedge of 23 degrees is as steep."""


@dataclass(frozen=True, eq=False)
class Embedding:
    """What of a closed surface does not change when its points move.

    Attributes
    ----------
    triangles : (m, 3) int
        Outward.
    means : (n, n) sparse
        Takes the mean over the points joined to each point.
    """

    triangles: Indices
    means: csr_array

    @classmethod
    def of(cls, triangles: Indices, *, count: int) -> Embedding:
        """Find the neighbours of `count` points."""
        return cls(triangles, neighbour_means(triangles, count=count))

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

    def openness(self, points: Floats) -> Floats:
        """Return the smallest cosine between each point's normal and those of its triangles, (n,) float.

        The point's normal is the mean of its triangles' unit normals.
        """
        return _openness(points, self.triangles)

    def folded(self, points: Floats, moved: Mask, *, least: Floats) -> Mask:
        """Return the points, (n,) bool, whose openness is less than `least`, (n,), of those around which some moved."""
        touched = grown(moved, self.means, 1)
        among = self.triangles[touched[self.triangles].any(axis=1)]
        folded: Mask = touched & (_openness(points, among) < least)
        return folded

    def faults_since(self, old: Floats) -> Faulty:
        """Return the test for crossings, and for folds sharper than those of the points `old`, (n, 3)."""
        least = np.minimum(self.openness(old), OPEN)

        def faulty(points: Floats, moved: Mask) -> Mask:
            wrong: Mask = self.crossed(points, moved) | self.folded(points, moved, least=least)
            return wrong

        return faulty


def _openness(points: Floats, triangles: Indices) -> Floats:
    """Return the smallest cosine between each point's normal and those of some triangles at it, (n,) float."""
    facets, normals = unit(area_vectors(points, triangles)), mean_normals(points, triangles)
    smallest = np.ones(len(points))
    np.minimum.at(smallest, triangles.ravel(), np.einsum("mi,mki->mk", facets, normals[triangles]).ravel())
    return smallest


def stored(points: Floats) -> Floats:
    """Return the points as float32 holds them, which is how files do; what is tested is then what is written."""
    rounded: Floats = points.astype(np.float32).astype(np.float64) + 0.0  # -0.0 becomes 0.0
    return rounded
