"""The smallest gap between two parts: exactly how wide, and where."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from manifold3d import Manifold

from fabricate.arrays import Floats, Indices, Mask, frozen
from fabricate.checks.facts import Gap, Xyz
from fabricate.triangles.adjacency import undirected_edges
from fabricate.triangles.edge_pieces import EdgePieces
from fabricate.triangles.near_distances import ROUNDING, near_distances
from fabricate.triangles.search_tree import SearchTree

SEARCH = 1.2
"""How far is looked for an exact gap, in clearances: farther costs time and nobody asks."""

UNKNOWN_SEARCH = 0.6
"""The same in mm, when the clearance is not known or 0."""

PLACE_TOLERANCE = 0.01
"""The place is good enough when the distance there exceeds the gap by this share."""

MEASURED = 2.01
"""Vertices are measured up to this many clearances, or gaps where these are wider: contacts are no farther apart."""

FIRST_SAMPLE = 1_000
"""About so many vertices of each part tell roughly how wide the gap is, before all that are near are measured."""

LONG = 0.9
"""Ends of edges longer than this share of how far vertices are measured are all measured: between its ends such an
edge may come near. A shorter one between vertices that are farther stays beyond the gap."""

ROUNDS, MOST_PIECES = 12, 10_000
"""How often pieces of edges are halved to find the place, and how many at a time."""


@dataclass(frozen=True, eq=False)
class Spacing:
    """Two parts, and how far each one's vertices are from the other.

    Attributes
    ----------
    first, second : SearchTree
    to_second : (n1,) float
        Distance of each of the first part's vertices to the second part's surface, mm; of those that are farther than
        twice the clearance, and twice the gap, something between that and their distance.
    to_first : (n2,) float
        The same the other way round.
    """

    first: SearchTree
    second: SearchTree
    to_second: Floats
    to_first: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "to_second", frozen(self.to_second, np.float64, (None,)))
        object.__setattr__(self, "to_first", frozen(self.to_first, np.float64, (None,)))

    @classmethod
    def between(cls, first: SearchTree, second: SearchTree, *, clearance: float | None) -> Spacing:
        """Measure from all vertices of either part that are near the other one, for parts `clearance` mm apart."""
        gap = min(_sampled(first, second), _sampled(second, first))
        reach = MEASURED * max(gap, clearance or UNKNOWN_SEARCH)
        to_second = near_distances(second, first.points, reach=reach, always=_at_long_edges(first, LONG * reach))
        to_first = near_distances(first, second.points, reach=reach, always=_at_long_edges(second, LONG * reach))
        return cls(first, second, to_second, to_first)


class _Spot(NamedTuple):
    """A point of one part, its distance from the other part, mm, and that part."""

    distance: float
    point: Floats
    other: SearchTree


def smallest_gap(spacing: Spacing, first: Manifold, second: Manifold, *, clearance: float | None) -> Gap:
    """Return the smallest gap between two parts, which Manifold holds as `first` and `second`.

    It is exact up to 1.2 clearances, or 0.6 mm if the clearance is not known or 0; beyond that it is the
    smallest distance of a vertex. The place is midway between the parts, where their distance is within 1 %
    of the gap, or the nearest to that which a bounded search finds. Parts that overlap have the gap 0,
    somewhere near the overlap: `min_gap` intersects them first, and measures only if that leaves nothing. Parts that
    touch with clearance 0 do so everywhere, and no place is named. What distance queries alone have found, at vertices
    and on edges, is `queried`: an upper bound that owes nothing to Manifold.
    """
    spot = min(_vertex_spots(spacing), key=lambda each: each.distance)
    if spot.distance == 0.0:
        return Gap(0.0, None if clearance == 0.0 else _midway(spot))
    search = min(spot.distance, SEARCH * clearance if clearance else UNKNOWN_SEARCH)
    exact = first.min_gap(second, search)
    if exact >= search:
        return Gap(spot.distance, _midway(spot), queried=spot.distance)
    if exact > 0.0:
        spot = min(_edge_spots(spacing, spot, exact), key=lambda each: each.distance)
    return Gap(min(exact, spot.distance), _midway(spot), queried=spot.distance)


def widest_gap(spacing: Spacing, middles: Floats) -> tuple[float, Xyz] | None:
    """Return the largest distance between two parts along the mid-line of their joint, mm, and where it is.

    `middles`, (k, 3), are places on the mid-line. The gap at each of them is how far the nearest place on the first
    part is from the second one.
    """
    if not len(middles):
        return None
    wall = spacing.first.nearest(middles).point
    across = spacing.second.nearest(wall)
    widest = int(across.distance.argmax())
    x, y, z = (float(value) for value in 0.5 * (wall[widest] + across.point[widest]))
    return float(across.distance[widest]), (x, y, z)


def _sampled(own: SearchTree, other: SearchTree) -> float:
    """Return the smallest distance of some of a part's vertices from another part, mm."""
    some = own.points[:: max(1, len(own.points) // FIRST_SAMPLE)]
    return float(other.nearest(some).distance.min())


def _at_long_edges(own: SearchTree, length: float) -> Mask:
    """Tell which points, (n,) bool, are ends of edges longer than this, mm."""
    ends = undirected_edges(own.triangles)
    ways = own.points[ends[:, 1]] - own.points[ends[:, 0]]
    at_long: Mask = np.zeros(len(own.points), dtype=bool)
    at_long[ends[np.einsum("ij,ij->i", ways, ways) > length**2]] = True
    return at_long


def _vertex_spots(spacing: Spacing) -> tuple[_Spot, _Spot]:
    """Return the nearest vertex of either part."""
    i, j = int(spacing.to_second.argmin()), int(spacing.to_first.argmin())
    return (
        _Spot(float(spacing.to_second[i]), spacing.first.points[i], spacing.second),
        _Spot(float(spacing.to_first[j]), spacing.second.points[j], spacing.first),
    )


def _edge_spots(spacing: Spacing, spot: _Spot, gap: float) -> tuple[_Spot, _Spot]:
    """Return the spots on the edges of either part whose distance comes nearest to the gap."""
    return (
        _on_edges(spacing.first, spacing.second, spacing.to_second, spot, gap),
        _on_edges(spacing.second, spacing.first, spacing.to_first, spot, gap),
    )


def _on_edges(own: SearchTree, other: SearchTree, distances: Floats, spot: _Spot, gap: float) -> _Spot:
    """Return a spot on the edges of `own` that is nearer to `other` than `spot`, or `spot` itself.

    Pieces of edges are halved, the most promising first, until one end is near enough (branch and bound).
    """
    pieces = EdgePieces.whole(own.points, _hopeful_edges(own, distances, gap), distances)
    for _ in range(ROUNDS):
        least = pieces.least
        order = np.argsort(least, kind="stable")[:MOST_PIECES]
        order = order[least[order] <= gap]
        if spot.distance <= (1.0 + PLACE_TOLERANCE) * gap or not len(order):
            break
        pieces = pieces.chosen(order).halved(other)
        middles, at_middle = pieces.ends[: len(order)], pieces.at_end[: len(order)]
        k = int(at_middle.argmin())
        if at_middle[k] < spot.distance:
            spot = _Spot(float(at_middle[k]), middles[k], other)
    return spot


def _hopeful_edges(own: SearchTree, distances: Floats, gap: float) -> Indices:
    """Return the edges that may come as near to another part as the gap, (e, 2) int.

    Where an edge is nearest between its ends, one of these is at most half its length from there, at right angles.
    """
    edges = undirected_edges(own.triangles)
    nearer = np.minimum(distances[edges[:, 0]], distances[edges[:, 1]])
    ways = own.points[edges[:, 1]] - own.points[edges[:, 0]]
    hopeful: Indices = edges[nearer**2 <= (1.0 + ROUNDING) * (gap**2 + 0.25 * np.einsum("ij,ij->i", ways, ways))]
    return hopeful


def _midway(spot: _Spot) -> tuple[float, float, float]:
    """Return the point midway between a spot and the nearest place on the other part."""
    x, y, z = 0.5 * (spot.point + spot.other.nearest(spot.point[None]).point[0])
    return float(x), float(y), float(z)
