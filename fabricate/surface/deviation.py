"""How far the finished outer surface lies from the surface that it stands for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices, frozen
from fabricate.triangles.normals import area_vectors
from fabricate.triangles.search_tree import SearchTree

SAMPLES = 200_000
"""Places spread over the surface, beside its points."""

_STEPS = (0.7548776662466927, 0.5698402909980532)
"""Fractions whose multiples fill the unit square evenly: powers of the inverse of the plastic number."""


@dataclass(frozen=True, eq=False)
class Deviation:
    """Distances from one surface to another, mm.

    Attributes
    ----------
    mean, p999, max : float
        Mean, the bound that 99.9 % of all places keep, and the largest one.
    at : (3,) float
        Where on the surface that is measured from the largest one was found, mm.
    """

    mean: float
    p999: float
    max: float
    at: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "at", frozen(self.at, np.float64, (3,)))


def deviation(points: Floats, triangles: Indices, onto_points: Floats, onto_triangles: Indices) -> Deviation:
    """Return how far the surface `onto` lies from the surface `points`, `triangles`; all in mm.

    Measured at every point of `onto`, where detail is finest, and at as many places spread evenly over its area
    as `SAMPLES` says, to the nearest place of the other surface. What one surface lacks is seen from the other
    only, so exchange the two for the opposite direction.
    """
    places = np.concatenate([onto_points, spread(onto_points, onto_triangles, count=SAMPLES)])
    distance = SearchTree.of(points, triangles).nearest(places).distance
    worst = int(distance.argmax())
    return Deviation(float(distance.mean()), float(np.quantile(distance, 0.999)), float(distance[worst]), places[worst])


def spread(points: Floats, triangles: Indices, *, count: int) -> Floats:
    """Return `count` places spread evenly over the area of a surface, (count, 3) float, mm; always the same ones.

    Each triangle gets its share of the places, and inside of triangles they follow a sequence of low discrepancy
    (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018).
    """
    area = np.cumsum(np.linalg.norm(area_vectors(points, triangles), axis=1))
    number = np.arange(count)
    owner = np.searchsorted(area, (number + 0.5) / count * area[-1])
    u, v = (number[:, None] * _STEPS % 1.0).T
    beyond = u + v > 1.0
    u, v = np.where(beyond, 1.0 - u, u)[:, None], np.where(beyond, 1.0 - v, v)[:, None]
    first, second, third = points[triangles[owner]].transpose(1, 0, 2)
    places: Floats = first + u * (second - first) + v * (third - first)
    return places
