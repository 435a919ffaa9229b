"""Ways in: the surface opens where none leads into the body through all triangles at a point.

Coarse cells in a thin or sharply bent part may fold round a point like that without crossing. Nothing can lie under it,
however near: an inner point would come out through one of its triangles. So such a point moves towards the mean of its
neighbours, and those around it do in the end, until there is a way.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.solid.inset import straight_down
from fabricate.surface.cut import CutSurface
from fabricate.surface.embedding import Embedding, Faulty, stored
from fabricate.surface.stepping import stepped
from fabricate.triangles.adjacency import grown
from fabricate.triangles.normals import area_vectors, unit

SHALLOW = 0.02
"""A way is none when its cosine with a triangle's own is no larger than this: numbers in files are no finer."""

ROUNDS, RING, SHARE = 16, 4, 0.5
"""How often the surface opens; after how many times those one edge further away move as well; and which share of the
way to the mean of its neighbours a point goes each time."""


def without_ways_in(points: Floats, triangles: Indices) -> Mask:
    """Return the points, (n,) bool, from which no way was found into the body through all triangles at them."""
    facets, ways = unit(area_vectors(points, triangles)), straight_down(points, triangles)
    shut: Mask = np.zeros(len(points), dtype=bool)
    cosine = -np.einsum("ij,ikj->ik", facets, ways[triangles])
    shut[triangles[cosine <= SHALLOW]] = True
    return shut


def opened(surface: CutSurface) -> CutSurface:
    """Return the surface with ways into the body from all its points, if moving a few of them gives these.

    What moves stays embedded; a surface with ways in everywhere is returned as it is.
    """
    if not without_ways_in(surface.points, surface.triangles).any():
        return surface
    points = opened_points(surface.points, surface.triangles)
    return replace(surface, points=points, base=surface.base + (points - surface.points))


def opened_points(points: Floats, triangles: Indices) -> Floats:
    """Return the points, (n, 3) mm, of a closed, embedded surface moved until they have ways in; float32-exact."""
    embedding = Embedding.of(triangles, count=len(points))
    points = stored(points)
    for step in range(ROUNDS):
        shut = without_ways_in(points, triangles)
        if not shut.any():
            break
        moving = SHARE * grown(shut, embedding.means, step // RING)[:, None]
        moved = points + moving * (embedding.means @ points - points)
        points = stepped(points, moved, embedding.means, _faults_but_for(shut, embedding))
    return points


def _faults_but_for(shut: Mask, embedding: Embedding) -> Faulty:
    """Return the test for crossings, and for other points than these, (n,) bool, that have no way in."""

    def faulty(points: Floats, moved: Mask) -> Mask:
        wrong: Mask = embedding.crossed(points, moved) | (without_ways_in(points, embedding.triangles) & ~shut)
        return wrong

    return faulty
