"""Inscribed balls: the largest ball that touches a surface at a place and fits in behind it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.triangles.search_tree import SearchTree

ROUNDS = 8
"""How often balls are shrunk at most."""

EXACT = 1e-3
"""A ball fits when nothing comes nearer to its centre than its radius by more than this share."""


class Balls(NamedTuple):
    """Balls that fit.

    Attributes
    ----------
    radius : (k,) float
        mm.
    triangle : (k,) int
        The triangle that stops each ball from being larger, -1 where none does.
    point : (k, 3) float
        Where it does; the place itself where none does.
    """

    radius: Floats
    triangle: Indices
    point: Floats


def inscribed_balls(tree: SearchTree, places: Floats, normals: Floats, *, largest: Floats) -> Balls:
    """Return the largest ball behind each place, (k, 3), of a surface with the unit normals, (k, 3), there.

    No ball is larger than `largest`, (k,) mm. A ball that something reaches into is shrunk until that only touches it
    (shrinking balls: Ma, Bae, Choi 2012), and so on.
    """
    radius, triangle, point = np.array(largest), np.full(len(places), -1), np.array(places)
    left = np.arange(len(places))
    for _ in range(ROUNDS):
        centres = places[left] - radius[left, None] * normals[left]
        found = tree.nearest(centres)
        away = places[left] - found.point
        ahead = np.einsum("ij,ij->i", away, normals[left])
        reached = (found.distance < (1.0 - EXACT) * radius[left]) & (ahead > 0.0)
        left, away, ahead = left[reached], away[reached], ahead[reached]
        if not len(left):
            break
        radius[left] = np.einsum("ij,ij->i", away, away) / (2.0 * ahead)
        triangle[left], point[left] = found.triangle[reached], found.point[reached]
    return Balls(radius, triangle, point)
