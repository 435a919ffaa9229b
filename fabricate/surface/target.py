"""Where the points of a surface belong on another surface close to it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.triangles.normals import area_vectors, unit
from fabricate.triangles.ray_casting import RayTarget
from fabricate.triangles.search_tree import SearchTree

AGREEING = 0.2
"""Least cosine between a ray and the normal of the triangle that it hits."""

FALLBACK_WEIGHT = 0.3
"""Trust in a nearest place, where the trust in a place that a ray hits is 1."""


class Aims(NamedTuple):
    """Where points belong, (n, 3) float mm, and how far that is to be trusted, (n,) float: 0 is not at all."""

    place: Floats
    weight: Floats


@dataclass(frozen=True, eq=False)
class Target:
    """A closed surface, outward, to carry points onto: trees for nearest places and rays, and unit normals, (m, 3)."""

    tree: SearchTree
    rays: RayTarget
    normals: Floats

    @classmethod
    def of(cls, points: Floats, triangles: Indices) -> Target:
        """Build the trees."""
        rays, normals = RayTarget.of(points, triangles), unit(area_vectors(points, triangles))
        return cls(SearchTree.of(points, triangles), rays, normals)

    def aims(self, points: Floats, normals: Floats, *, reach: float) -> Aims:
        """Return where points with unit normals belong: where a ray along the normal leads, else the nearest place.

        A ray outward must leave the target and a ray inward must enter it, so that at most one of them counts:
        a point inside of the target goes out to its surface, one outside goes in, and neither passes through any
        other sheet on its way. A point has no aim beyond `reach` mm, nor one that faces the other way.
        """
        way, found = self._along(points, normals, reach)
        place = points + way[:, None] * normals
        weight = found.astype(np.float64)
        rest = np.flatnonzero(~found)
        if len(rest):
            nearest = self.tree.nearest(points[rest])
            facing = np.einsum("ij,ij->i", self.normals[nearest.triangle], normals[rest])
            good = (facing > 0.0) & (nearest.distance < reach)
            place[rest[good]], weight[rest[good]] = nearest.point[good], FALLBACK_WEIGHT
        return Aims(place, weight)

    def _along(self, points: Floats, normals: Floats, reach: float) -> tuple[Floats, Mask]:
        """Return the signed distance along the normal, (n,) mm, and where there is one, (n,) bool."""
        both = np.concatenate([normals, -normals])
        hits = self.rays.first_hits(np.tile(points, (2, 1)), both)
        agreeing = np.einsum("ij,ij->i", self.normals[hits.triangle], np.tile(normals, (2, 1))) > AGREEING
        outward, inward = ((hits.triangle >= 0) & (hits.distance < reach) & agreeing).reshape(2, -1)
        out, into = hits.distance.reshape(2, -1)
        way: Floats = np.where(outward, out, np.where(inward, -into, 0.0))
        return way, outward | inward
