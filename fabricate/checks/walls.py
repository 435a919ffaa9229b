"""Walls of a part: how thick they are, by rays straight inward and by balls that fit in.

A ray goes from a place on the surface straight inward to the opposite wall. It misses what comes near from the side;
the largest ball that touches the surface at that place from within, and fits into the part, does not.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices, Mask, frozen
from fabricate.checks.facts import Spread
from fabricate.solid.part import Part
from fabricate.triangles.inscribed_balls import inscribed_balls
from fabricate.triangles.ray_casting import Hits, RayTarget
from fabricate.triangles.search_tree import SearchTree

MOST_RAYS = 200_000
"""Of a part with more triangles, only every second, third ... one sends a ray."""

MOST_BALLS = 5_000
"""So many places of the part get a ball: half of them where it is thinnest, the others evenly all over it."""

CLOSER = 400
"""So many of the places with the thinnest walls are looked at more closely, on the triangles at either end."""

DIVISIONS = 4
"""Each side of such a triangle is divided into so many steps, and a ray begins at each place of the grid."""

INSIDE = 0.98
"""The grid is shrunk to this size about the triangle's middle, so that no ray slips out beside a sharp edge."""

START = 1e-4
"""How far under its triangle a ray begins, mm, so that it does not hit that triangle."""

START_SHARE = 1e-6
"""The same as a share of the part's size, for parts so large that single precision asks for more."""

OPPOSITE = -0.8
"""Two faces are opposite walls when the cosine between their normals is less."""


ACROSS = 0.95
"""A ball is stopped on the far side when the cosine between the way there and the way straight inward is more: between
two planes this is the same angle."""


@dataclass(frozen=True, eq=False)
class Walls:
    """Measured walls, the thinnest first.

    Attributes
    ----------
    thickness : (k,) float
        Distance from a place on the surface to the opposite wall, mm.
    places : (k, 3) float
        Where it was measured from.
    areas : (k,) float
        Its weight: area of the triangle measured from its middle, mm2; 0 for all other places.
    faces : (k, 2) int
        The triangle measured from, and the opposite one.
    """

    thickness: Floats
    places: Floats
    areas: Floats
    faces: Indices

    def __post_init__(self) -> None:
        object.__setattr__(self, "thickness", frozen(self.thickness, np.float64, (None,)))
        object.__setattr__(self, "places", frozen(self.places, np.float64, (None, 3)))
        object.__setattr__(self, "areas", frozen(self.areas, np.float64, (None,)))
        object.__setattr__(self, "faces", frozen(self.faces, np.int64, (None, 2)))

    @property
    def spread(self) -> Spread | None:
        """The smallest thickness, and that which half of the measured area exceeds; None without walls."""
        if not len(self.thickness):
            return None
        below = np.cumsum(self.areas)
        median = self.thickness[np.searchsorted(below, 0.5 * below[-1])]
        return Spread(float(self.thickness[0]), float(median))

    def share_below(self, thickness: float) -> float:
        """Return the share of the measured area whose wall is thinner, between 0 and 1."""
        return float(self.areas[self.thickness < thickness].sum() / self.areas.sum())


class _Sent(NamedTuple):
    """Places on triangles, (k,) int, from which walls are measured: (k, 3) float mm, and their weights, (k,)."""

    triangles: Indices
    places: Floats
    areas: Floats


@dataclass(frozen=True, eq=False)
class _Probe:
    """A part about the origin, where single precision is finest, and what walls are measured with."""

    points: Floats
    triangles: Indices
    normals: Floats
    target: RayTarget
    start: float

    def hit(self, sent: _Sent) -> Hits:
        """Return what rays from these places straight inward meet first."""
        inward = -self.normals[sent.triangles]
        hits = self.target.first_hits(sent.places + self.start * inward, inward)
        return Hits(hits.triangle, hits.distance + self.start)

    def opposite(self, sent: _Sent, hits: Hits) -> Walls:
        """Return the walls that rays have measured: where what they met is an opposite face."""
        cosines = np.einsum("ij,ij->i", self.normals[sent.triangles], self.normals[hits.triangle])
        good = (hits.triangle >= 0) & (cosines < OPPOSITE)
        # At its very edge every blade is thin: only middles of triangles count beside the edge that they share.
        beside = np.flatnonzero(good & (sent.areas == 0.0))
        good[beside] = ~self._meet(sent.triangles[beside], hits.triangle[beside])
        faces = np.column_stack([sent.triangles, hits.triangle])
        return Walls(hits.distance[good], sent.places[good], sent.areas[good], faces[good])

    def fitted(self, sent: _Sent, largest: Floats, tree: SearchTree, middle: Floats) -> Walls:
        """Return the walls that balls have measured: where one is stopped on the far side.

        `largest` are the diameters to begin with, (k,) mm; `tree` is that of the part in its place, with `middle` at
        the probe's origin.
        """
        normals = self.normals[sent.triangles]
        balls = inscribed_balls(tree, sent.places + middle, normals, largest=0.5 * largest)
        across = balls.point - (sent.places + middle)
        thickness = np.linalg.norm(across, axis=1)
        good = (balls.triangle >= 0) & (-np.einsum("ij,ij->i", across, normals) > ACROSS * thickness)
        good &= ~self._meet(sent.triangles, balls.triangle)
        faces = np.column_stack([sent.triangles, balls.triangle])
        return Walls(thickness[good], sent.places[good], np.zeros(good.sum()), faces[good])

    def _meet(self, first: Indices, second: Indices) -> Mask:
        """Tell which pairs of triangles share a point."""
        meet: Mask = (self.triangles[first][:, :, None] == self.triangles[second][:, None, :]).any(axis=(1, 2))
        return meet


def walls(part: Part, tree: SearchTree, vectors: Floats) -> Walls:
    """Measure the walls of a part: from the middle of each triangle to the first face, if that is opposite.

    Triangles with the thinnest walls are measured from places all over them, and balls look for what rays have missed.
    Where the first face is not opposite, as near an edge of more than 37 degrees, there is no wall; a sharper
    edge is one that gets thin. `tree` and the area vectors, (m, 3) mm2, are the part's.
    """
    lengths = np.linalg.norm(vectors, axis=1)
    sending = np.flatnonzero(lengths > 0.0)
    sending = sending[:: max(1, -(-len(sending) // MOST_RAYS))]
    if not len(sending):
        return Walls(np.zeros(0), np.zeros((0, 3)), np.zeros(0), np.zeros((0, 2), dtype=np.int64))
    middle = part.points.mean(axis=0)
    points = part.points - middle
    probe = _Probe(
        points,
        part.triangles,
        vectors / np.where(lengths > 0.0, lengths, 1.0)[:, None],
        RayTarget.of(points, part.triangles),
        max(START, START_SHARE * float(np.ptp(points, axis=0).max())),
    )
    sent = _Sent(sending, points[part.triangles[sending]].mean(axis=1), 0.5 * lengths[sending])
    hits = probe.hit(sent)
    by_rays, by_balls = probe.opposite(sent, hits), _by_balls(probe, sent, hits, tree, middle)
    closer = _grid(probe, [by_rays, by_balls])
    hits = probe.hit(closer)
    found = _joined([by_rays, by_balls, probe.opposite(closer, hits), _by_balls(probe, closer, hits, tree, middle)])
    return Walls(found.thickness, found.places + middle, found.areas, found.faces)


def _joined(several: list[Walls]) -> Walls:
    """Return all walls of several, the thinnest first."""
    thickness = np.concatenate([each.thickness for each in several])
    order = np.argsort(thickness, kind="stable")
    return Walls(
        thickness[order],
        *(np.concatenate([getattr(each, name) for each in several])[order] for name in ("places", "areas", "faces")),
    )


def _grid(probe: _Probe, found: list[Walls]) -> _Sent:
    """Return a grid of places on the triangles at either end of the thinnest walls."""
    thickness, faces = (np.concatenate([getattr(each, name) for each in found]) for name in ("thickness", "faces"))
    triangles = np.unique(faces[np.argsort(thickness, kind="stable")[:CLOSER]])
    steps = np.array([(i, j) for i in range(DIVISIONS + 1) for j in range(DIVISIONS + 1 - i)]) / DIVISIONS
    weights = INSIDE * np.column_stack([steps, 1.0 - steps.sum(axis=1)]) + (1.0 - INSIDE) / 3
    places = np.einsum("gc,tcx->tgx", weights, probe.points[probe.triangles[triangles]]).reshape(-1, 3)
    return _Sent(np.repeat(triangles, len(weights)), places, np.zeros(len(places)))


def _by_balls(probe: _Probe, sent: _Sent, hits: Hits, tree: SearchTree, middle: Floats) -> Walls:
    """Return the walls that balls find: half of them are tried where rays were shortest, the others evenly."""
    order = np.argsort(hits.distance, kind="stable")
    order = order[: np.isfinite(hits.distance).sum()]
    half = MOST_BALLS // 2
    if len(order) > MOST_BALLS:
        order = np.concatenate([order[:half], order[half :: -(-(len(order) - half) // half)]])
    order = np.sort(order)  # neighbouring triangles have near numbers, and near places are found faster one by one
    chosen = _Sent(sent.triangles[order], sent.places[order], sent.areas[order])
    return probe.fitted(chosen, hits.distance[order], tree, middle)
