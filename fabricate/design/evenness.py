"""Evenness: whether yellow has the same share of the area wherever one looks."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array, eye_array

from fabricate.arrays import Floats, Indices
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.limit import limit_vertices

STEPS = 3
"""How many steps from tile to tile a neighbourhood reaches: 25 tiles where four meet at every point."""


def unevenness(duotone: Duotone, *, arc: float) -> float:
    """Return how much the yellow share of a neighbourhood differs from the target, root mean square over all tiles.

    A neighbourhood is a tile and those within three steps across tile sides, each with the chance that a walk that
    stays or crosses one of the four sides ends there: a window without an edge that slides over the surface and never
    looks through a wall. Shares of tiles are those of flat squares, areas those of the limit surface. The target is the
    share of a surface half of whose tiles are joined, 1/2 + (pi/4) (2 r - 1) (Garigipati 2013, 4.2).
    """
    return float(np.sqrt(np.square(_deviations(duotone, arc, _window(duotone.quads))).mean()))


def chance_unevenness(quads: QuadMesh, *, arc: float) -> float:
    """Return the unevenness to be expected if a coin were tossed for each tile."""
    return _chance(_window(quads), arc)


class EvennessCost:
    """`weight` times the sum of all neighbourhoods' squared deviations; see `fabricate.design.local_cost`.

    Deviations are measured in those that chance would give, so that the cost is about the number of tiles.
    """

    def __init__(self, duotone: Duotone, *, arc: float, weight: float) -> None:
        window = _window(duotone.quads)
        swing = _swing(arc)
        self._pairs = csr_array(window.T @ window)
        self._own = self._pairs.diagonal()
        self._slope: Floats = window.T @ _deviations(duotone, arc, window)
        self._step = np.where(duotone.joined, -swing, swing)
        self._weight = weight / _chance(window, arc) ** 2

    def changes(self, tiles: Indices) -> Floats:
        """Return by how much the cost would change if one of these tiles were flipped, for each of them."""
        step = self._step[tiles]
        change: Floats = self._weight * step * (2.0 * self._slope[tiles] + step * self._own[tiles])
        return change

    def flip(self, tile: int) -> None:
        """Take note that a tile is flipped."""
        row = slice(self._pairs.indptr[tile], self._pairs.indptr[tile + 1])
        self._slope[self._pairs.indices[row]] += self._step[tile] * self._pairs.data[row]
        self._step[tile] *= -1.0


def _chance(window: csr_array, arc: float) -> float:
    return 0.5 * _swing(arc) * float(np.sqrt(window.power(2).sum() / window.shape[0]))


def _swing(arc: float) -> float:
    """Return by how much the yellow share of a flat square tile grows when it becomes yellow-joined."""
    return 1.0 - 0.5 * np.pi * ((1.0 - arc) ** 2 + arc**2)


def _deviations(duotone: Duotone, arc: float, window: csr_array) -> Floats:
    """Return the yellow share of each neighbourhood less the target, (t,) float."""
    sign = np.where(duotone.joined, 0.5, -0.5)
    found: Floats = _swing(arc) * (window @ sign)
    return found


def _window(quads: QuadMesh) -> csr_array:
    """Return the share of each tile in the area of each neighbourhood, (t, t); rows sum to 1."""
    tiles = len(quads.tiles)
    here = np.repeat(np.arange(tiles), 4)
    beside = coo_array((np.ones(4 * tiles), (here, quads.twins // 4)), shape=(tiles, tiles)).tocsr()
    walk = csr_array(eye_array(tiles, format="csr") + beside) / 5.0
    reached = walk
    for _ in range(STEPS - 1):
        reached = csr_array(reached @ walk)
    weighed = csr_array(reached @ diags_array(_areas(quads)))
    return csr_array(diags_array(1.0 / weighed.sum(axis=1)) @ weighed)


def _areas(quads: QuadMesh) -> Floats:
    """Return the areas of the tiles between their corners on the limit surface, (t,) float, mm2."""
    a, b, c, d = np.moveaxis(limit_vertices(quads)[quads.tiles], 1, 0)
    areas: Floats = 0.5 * np.linalg.norm(np.cross(c - a, d - b), axis=1)
    return areas
