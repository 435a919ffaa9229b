"""Spacing: the outer surface gives way where the parts' copies of it come nearer to each other than the clearance.

However little is under them, walls are no further apart than the outer surfaces that they hang from. These come too
near where tiles are hardly larger than the clearance, and on opposite sides of a body that is hardly thicker. So points
of one part's surface that are too near to another's push away from it, those around them give way, less and less with
the distance along the surface, and the surface takes as much of that step as keeps it embedded: small tiles grow at the
cost of those around them, and a sheet becomes as thick as the gap.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import dijkstra

from fabricate.arrays import Floats, Indices
from fabricate.solid.layers import layer, layer_shares
from fabricate.solid.unfolding import unfolded
from fabricate.surface.cut import CutSurface
from fabricate.surface.embedding import Embedding, stored
from fabricate.surface.stepping import stepped
from fabricate.triangles.search_tree import SearchTree

ENOUGH, AIM = 0.985, 1.02
"""Share of the clearance from which on copies are far enough apart, and the one that they are pushed to."""

ROUNDS, PATIENCE = 16, 4
"""How often copies are measured and pushed, and how often without fewer that are too near."""

GIVES_WAY = 4.0
"""How far along the surface, in clearances, others give way to a push."""

STRENGTH, FARTHEST = 0.75, 0.3
"""Share of what is missing that each side is pushed by in a round, and the farthest push, in clearances."""

STEADYING = 3
"""How often pushes are averaged with those around."""

FOLDED, OPENED = 0.4, 0.5
"""Where a triangle at a point is steeper than this cosine against the point's normal, and in the way of a push, the
surface opens: points there move such a share of the way to the mean of their neighbours."""


def spaced(surface: CutSurface, *, clearance: float) -> CutSurface:
    """Return the surface with its points moved so that copies of its regions are `clearance` apart, mm, if they can be.

    What moves stays embedded; a surface with room everywhere is returned as it is.
    """
    if clearance == 0.0:
        return surface
    embedding = Embedding.of(surface.triangles, count=len(surface.points))
    fewest, waited = len(surface.points), 0
    for _ in range(ROUNDS):
        pushes = _pushes(surface, clearance=clearance)
        near = int(pushes.any(axis=1).sum())
        fewest, waited = min(fewest, near), waited + 1 if near >= fewest else 0
        if not near or waited == PATIENCE:
            break
        old = stored(surface.points)
        folded = pushes.any(axis=1) & (embedding.openness(old) < FOLDED)
        opening = OPENED * np.where(folded[:, None], embedding.means @ old - old, 0.0)
        points = stepped(old, old + pushes + opening, embedding.means, embedding.faults_since(old))
        surface = replace(surface, points=points, base=surface.base + (points - old))
    return surface


def outer_copies(surface: CutSurface, *, clearance: float) -> tuple[Floats, ...]:
    """Return each region's own copy of the surface, (n, 3) mm, moved away from the others by half the clearance."""
    wanted = np.full(surface.curves.shape, clearance)
    shares = layer_shares(surface, surface.points, -surface.normals, clearance=wanted)
    return layer(surface, surface.points, unfolded(surface, surface.points, shares)).copies


def _pushes(surface: CutSurface, *, clearance: float) -> Floats:
    """Return how far each point is to move, (n, 3) mm, for the clearance between copies of the regions."""
    copies = outer_copies(surface, clearance=clearance)
    total, sides = np.zeros_like(surface.points), np.zeros(len(surface.points))
    for region, copy in enumerate(copies):
        own = surface.triangles[surface.regions == region]
        others = [surface.triangles[surface.regions == other] for other in range(len(copies)) if other != region]
        begins = np.arange(len(others)) * len(copy)
        tree = SearchTree.of(
            np.concatenate([other for number, other in enumerate(copies) if number != region]),
            np.concatenate([each + begin for each, begin in zip(others, begins, strict=True)]),
        )
        repelled = _repelled(copy, own, tree, clearance=clearance)
        handed = _given_way(surface.points, own, repelled, reach=GIVES_WAY * clearance)
        numbers = np.unique(own)
        total[numbers] += handed[numbers]
        sides[numbers] += 1.0
    pushes: Floats = total / np.maximum(sides, 1.0)[:, None]
    return pushes


def _repelled(points: Floats, triangles: Indices, other: SearchTree, *, clearance: float) -> Floats:
    """Return the pushes, (n, 3) mm, of points that are too near to other triangles, or on an edge that is."""
    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    numbers = np.unique(triangles)
    distance = np.full(len(points), np.inf)
    nearest = other.nearest(points[numbers])
    distance[numbers] = nearest.distance
    pushes = np.zeros_like(points)
    pushes[numbers] = _push(points[numbers], nearest.point, nearest.distance, clearance=clearance)
    length = np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1)
    ends = ends[distance[ends].min(axis=1) < ENOUGH * clearance + 0.5 * length]
    middles = points[ends].mean(axis=1)
    between = other.nearest(middles) if len(ends) else None
    if between is not None:
        push = _push(middles, between.point, between.distance, clearance=clearance)
        for end in ends.T:
            larger = np.linalg.norm(push, axis=1) > np.linalg.norm(pushes[end], axis=1)
            pushes[end[larger]] = push[larger]
    return pushes


def _push(points: Floats, nearest: Floats, distance: Floats, *, clearance: float) -> Floats:
    """Return for points, (k, 3), that are too near to their nearest place how far they are to go away from it."""
    missing = np.where(distance < ENOUGH * clearance, AIM * clearance - distance, 0.0)
    size = np.minimum(STRENGTH * missing, FARTHEST * clearance)
    push: Floats = (size / np.maximum(distance, 1e-9))[:, None] * (points - nearest)
    return push


def _given_way(points: Floats, triangles: Indices, pushes: Floats, *, reach: float) -> Floats:
    """Return the pushes, (n, 3) mm, handed on within some triangles: to each point that of the nearest one pushed."""
    pushed = np.flatnonzero(pushes.any(axis=1))
    if not len(pushed):
        return pushes
    graph = _lengths(points, triangles)
    distance, _, source = dijkstra(graph, indices=pushed, min_only=True, limit=reach, return_predecessors=True)
    reached = np.isfinite(distance)
    handed = np.zeros_like(pushes)
    handed[reached] = (1.0 - distance[reached] / reach)[:, None] * pushes[source[reached]]
    means = csr_array(graph.astype(bool).astype(np.float64))
    degree = np.maximum(means.sum(axis=1), 1.0)[:, None]
    for _ in range(STEADYING):
        handed = 0.5 * (handed + means @ handed / degree)
    return handed


def _lengths(points: Floats, triangles: Indices) -> csr_array:
    """Return the (n, n) matrix of the lengths of edges, in both directions."""
    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    ends = np.unique(np.sort(ends, axis=1), axis=0)
    length = np.maximum(np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1), 1e-9)
    rows, columns = np.concatenate([ends, ends[:, ::-1]]).T
    return coo_array((np.tile(length, 2), (rows, columns)), shape=(len(points),) * 2).tocsr()
