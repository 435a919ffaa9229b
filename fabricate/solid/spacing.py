"""Spacing: the outer surface gives way where the parts' copies of it come nearer to each other than the clearance.

However little is under them, walls are no further apart than the outer surfaces that they hang from. These come too
near where tiles are hardly larger than the clearance, and on opposite sides of a body that is hardly thicker. So points
of one part's surface that are too near to another's push away from it, those around them give way, less and less with
the distance along the surface, and the surface takes as much of that step as keeps it embedded: small tiles grow at the
cost of those around them, and a sheet becomes as thick as the gap.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import dijkstra

from fabricate.arrays import Floats, Indices, Mask
from fabricate.solid.layers import layer, layer_shares
from fabricate.solid.unfolding import unfolded
from fabricate.surface.cut import CutSurface
from fabricate.surface.embedding import Embedding, stored
from fabricate.surface.stepping import stepped
from fabricate.triangles.adjacency import grown
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.search_tree import SearchTree

ENOUGH, WANTED, AIM = 0.97, 0.985, 1.02
"""Shares of the clearance: from which on copies are far enough apart; nearer than which they push, if any are too
near; and which they are pushed to."""

ROUNDS, PATIENCE = 32, 8
"""How often copies are measured and pushed, and how often without less missing."""

WATCHED = 1.25
"""Only points nearer than so many clearances at first are measured again."""

AROUND = 2
"""How far around copies that cross themselves the surface opens, in edges."""

GIVES_WAY = 4.0
"""How far along the surface, in clearances, others give way to a push."""

STRENGTH, FARTHEST = 0.75, 0.3
"""Share of what is missing that each side is pushed by in a round, and the farthest push, in clearances."""

STEADYING = 3
"""How often pushes are averaged with those around."""

FOLDED, OPENED = 0.4, 0.5
"""Where a triangle at a point is steeper than this cosine against the point's normal, or a copy would have folded, and
pushes are in vain, the surface opens: points there move such a share of the way to the mean of their neighbours."""


def spaced(surface: CutSurface, *, clearance: float) -> CutSurface:
    """Return the surface with its points moved so that copies of its regions are `clearance` apart, mm, if they can be.

    What moves stays embedded; a surface with room everywhere is returned as it is.
    """
    if clearance == 0.0:
        return surface
    embedding = Embedding.of(surface.triangles, count=len(surface.points))
    watched: Mask = np.ones(len(surface.points), dtype=bool)
    best, least, waited = surface, np.inf, 0
    for step in range(ROUNDS):
        found = _pushes(surface, watched, clearance=clearance)
        missing = np.maximum(ENOUGH - found.distance / clearance, 0.0).sum() + found.crossing.sum()
        waited = 0 if missing < least else waited + 1
        if missing < least:
            best, least = surface, missing
        if missing == 0.0 or waited == PATIENCE:
            break
        if step == 0:
            watched = found.distance < WATCHED * clearance
        surface = _pushed(surface, found, embedding)
    return best


def _pushed(surface: CutSurface, found: _Found, embedding: Embedding) -> CutSurface:
    """Return the surface after as much of the pushes as keeps it embedded; it opens where they are in vain."""
    old = stored(surface.points)
    folded = found.pushes.any(axis=1) & (found.eased | (embedding.openness(old) < FOLDED))
    folded |= grown(found.crossing, embedding.means, AROUND)
    opening = OPENED * np.where(folded[:, None], embedding.means @ old - old, 0.0)
    points = stepped(old, old + found.pushes + opening, embedding.means, embedding.faults_since(old))
    return replace(surface, points=points, base=surface.base + (points - old))


class _Found(NamedTuple):
    """How far each point is to move, (n, 3) mm, how far its copies are from other regions', (n,) mm or infinite.

    And which points are on rays on which a copy would have folded, and where copies cross themselves, (n,) bool.
    """

    pushes: Floats
    distance: Floats
    eased: Mask
    crossing: Mask


def outer_copies(surface: CutSurface, *, clearance: float) -> tuple[Floats, ...]:
    """Return each region's own copy of the surface, (n, 3) mm, moved away from the others by half the clearance."""
    return _copies(surface, clearance=clearance).places


class _Copies(NamedTuple):
    """Each region's own copy of the surface, (n, 3) mm, and the points on rays that would have folded, (n,) bool."""

    places: tuple[Floats, ...]
    eased: Mask


def _copies(surface: CutSurface, *, clearance: float) -> _Copies:
    wanted = np.full(surface.curves.shape, clearance)
    shares = layer_shares(surface, surface.points, -surface.normals, clearance=wanted)
    found = unfolded(surface, surface.points, shares)
    eased: Mask = np.zeros(len(surface.points), dtype=bool)
    for half_rays, before, after in zip(surface.half_rays, shares, found, strict=True):
        for rays, own, less in zip(half_rays, before, after, strict=True):
            eased[rays[less < own]] = True
    return _Copies(layer(surface, surface.points, found).copies, eased)


def _pushes(surface: CutSurface, watched: Mask, *, clearance: float) -> _Found:
    """Measure copies at the watched points, (n,) bool, and find how the surface gives way where they are too near."""
    copies, eased = _copies(surface, clearance=clearance)
    total, sides = np.zeros_like(surface.points), np.zeros(len(surface.points))
    distance, crossing = np.full(len(surface.points), np.inf), np.zeros(len(surface.points), dtype=bool)
    for region, copy in enumerate(copies):
        own = surface.triangles[surface.regions == region]
        others = [surface.triangles[surface.regions == other] for other in range(len(copies)) if other != region]
        begins = np.arange(len(others)) * len(copy)
        tree = SearchTree.of(
            np.concatenate([other for number, other in enumerate(copies) if number != region]),
            np.concatenate([each + begin for each, begin in zip(others, begins, strict=True)]),
        )
        own = own[watched[own].any(axis=1)]
        repelled, away = _repelled(copy, own, tree, clearance=clearance)
        numbers = np.unique(own)
        total[numbers] += _given_way(surface.points, own, repelled, reach=GIVES_WAY * clearance)[numbers]
        distance = np.minimum(distance, away)
        crossing[own[crossing_triangles(stored(copy), own)].ravel()] = True
        sides[numbers] += 1.0
    return _Found(total / np.maximum(sides, 1.0)[:, None], distance, eased, crossing)


def _repelled(points: Floats, triangles: Indices, other: SearchTree, *, clearance: float) -> tuple[Floats, Floats]:
    """Return the pushes, (n, 3), of points too near to other triangles or on such edges, and distances, (n,); mm."""
    ends = _edges(triangles)
    numbers = np.unique(triangles)
    distance, pushes = np.full(len(points), np.inf), np.zeros_like(points)
    nearest = other.nearest(points[numbers])
    distance[numbers] = nearest.distance
    pushes[numbers] = _push(points[numbers], nearest.point, nearest.distance, clearance=clearance)
    length = np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1)
    ends = ends[distance[ends].min(axis=1) < WANTED * clearance + 0.5 * length]
    if len(ends):
        middles = points[ends].mean(axis=1)
        between = other.nearest(middles)
        push = _push(middles, between.point, between.distance, clearance=clearance)
        for end in ends.T:
            larger = np.linalg.norm(push, axis=1) > np.linalg.norm(pushes[end], axis=1)
            pushes[end[larger]] = push[larger]
            np.minimum.at(distance, end, between.distance)
    return pushes, distance


def _push(points: Floats, nearest: Floats, distance: Floats, *, clearance: float) -> Floats:
    """Return for points, (k, 3), that are too near to their nearest place how far they are to go away from it."""
    missing = np.where(distance < WANTED * clearance, AIM * clearance - distance, 0.0)
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
    ends = _edges(triangles)
    length = np.maximum(np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1), 1e-9)
    rows, columns = np.concatenate([ends, ends[:, ::-1]]).T
    return coo_array((np.tile(length, 2), (rows, columns)), shape=(len(points),) * 2).tocsr()


def _edges(triangles: Indices) -> Indices:
    """Return each edge of some triangles once, (e, 2) int."""
    ends = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    base = int(triangles.max(initial=0)) + 1
    return np.stack(np.divmod(np.unique(ends[:, 0] * base + ends[:, 1]), base), axis=1)
