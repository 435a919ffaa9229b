"""Wall thickness of a part, measured by rays from its surface straight inward."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, frozen
from fabricate.checks.facts import Spread
from fabricate.solid.part import Part
from fabricate.triangles.normals import area_vectors
from fabricate.triangles.ray_casting import first_hits

MOST_RAYS = 200_000
"""Of a part with more triangles, only every second, third ... one sends a ray."""

START = 1e-4
"""How far under its triangle a ray begins, mm, so that it does not hit that triangle."""

START_SHARE = 1e-6
"""The same as a share of the part's size, for parts so large that single precision asks for more."""

OPPOSITE = -0.8
"""Two faces are opposite walls when the cosine between their normals is less."""


@dataclass(frozen=True, eq=False)
class Walls:
    """Measured walls, the thinnest first.

    Attributes
    ----------
    thickness : (k,) float
        Distance from the middle of a triangle, straight inward, to the opposite wall, mm.
    places : (k, 3) float
        Where it was measured from.
    areas : (k,) float
        Area of the triangle, mm2: its weight.
    """

    thickness: Floats
    places: Floats
    areas: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "thickness", frozen(self.thickness, np.float64, (None,)))
        object.__setattr__(self, "places", frozen(self.places, np.float64, (None, 3)))
        object.__setattr__(self, "areas", frozen(self.areas, np.float64, (None,)))

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


def walls(part: Part) -> Walls:
    """Measure the walls of a part: from the middle of each triangle to the first face, if that is opposite.

    Where the first face is not opposite, as near an edge of more than 37 degrees, there is no wall; a sharper
    edge is one that gets thin.
    """
    vectors = area_vectors(part.points, part.triangles)
    lengths = np.linalg.norm(vectors, axis=1)
    normals = vectors / np.where(lengths > 0.0, lengths, 1.0)[:, None]
    sending = np.flatnonzero(lengths > 0.0)
    sending = sending[:: max(1, -(-len(sending) // MOST_RAYS))]
    if not len(sending):
        return Walls(np.zeros(0), np.zeros((0, 3)), np.zeros(0))
    middle = part.points.mean(axis=0)  # single precision is finest near the origin
    points, inward = part.points - middle, -normals[sending]
    places = points[part.triangles[sending]].mean(axis=1)
    start = max(START, START_SHARE * float(np.ptp(points, axis=0).max()))
    hits = first_hits(points, part.triangles, places + start * inward, inward)
    cosines = np.einsum("ij,ij->i", normals[sending], normals[hits.triangle])
    opposite = (hits.triangle >= 0) & (cosines < OPPOSITE)
    thickness = hits.distance[opposite] + start
    order = np.argsort(thickness, kind="stable")
    measured = sending[opposite][order]
    return Walls(thickness[order], places[opposite][order] + middle, 0.5 * lengths[measured])
