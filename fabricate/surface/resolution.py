"""How finely to tessellate: the resolution that keeps the chord error below a tolerance in mm."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.duotone.duotone import Duotone
from fabricate.errors import PatternError
from fabricate.surface.limit import LimitSurface, Samples
from fabricate.surface.template import TileTemplate, ray_steps, tile_template

MIN_RESOLUTION = 3
"""Below this the curve turns by more than 30 degrees at a point, and facing walls would lean on each other."""

MAX_TRIANGLES = 4_000_000
"""Refuse a tolerance that would need a larger outer surface than this."""

SHARE_WITHIN, WORST_FACTOR = 0.99, 4.0
"""The tolerance holds on this share of all edges, and no edge is off by more than this many times it.

Curvature is unbounded at extraordinary vertices of a Catmull-Clark surface, so the error of the few edges around
them falls more slowly than with the square of the resolution; refining everything for their sake is a waste.
"""


def resolution_for(
    duotone: Duotone,
    limit: LimitSurface,
    *,
    rings: Sequence[float],
    tolerance: float,
    share: float = SHARE_WITHIN,
    worst: float = WORST_FACTOR,
) -> int:
    """Return the smallest resolution, at least 3, that keeps the chord error within `tolerance` mm.

    It does on that share of the edges, and no edge is off by more than `worst` times the tolerance. The error falls
    with the square of the resolution: it is measured at a coarse one, predicted from there, and then measured until
    it holds.

    Raises
    ------
    PatternError
        If the tessellation would have more than four million triangles.
    """
    coarse = chord_errors(duotone, limit, rings=rings, resolution=2)
    predicted = 2.0 * np.sqrt(float(np.quantile(coarse, share)) / tolerance)
    resolution = max(MIN_RESOLUTION, int(0.8 * predicted))
    while True:
        triangles = _triangles(rings, resolution) * len(duotone.joined)
        if triangles > MAX_TRIANGLES:
            raise PatternError(
                f"a tolerance of {tolerance:g} mm needs {triangles} triangles on the outer surface, more than "
                f"{MAX_TRIANGLES}; ask for a larger solid.tolerance or a larger pattern.tile_size"
            )
        errors = chord_errors(duotone, limit, rings=rings, resolution=resolution)
        within = float(np.quantile(errors, share)) <= tolerance
        if within and float(errors.max()) <= worst * tolerance:
            return resolution
        resolution += 1


def _triangles(rings: Sequence[float], resolution: int) -> int:
    """Return the number of triangles of one tile."""
    return 2 * resolution * (2 * sum(ray_steps(rings=rings, resolution=resolution)) - 1)


def chord_errors(duotone: Duotone, limit: LimitSurface, *, rings: Sequence[float], resolution: int) -> Floats:
    """Return the chord error at the middle of every template edge on every tile, flat, mm.

    It is how far the smooth surface, or on an arc the smooth curve, lies from the straight edge.
    """
    errors = []
    for kind in (False, True):
        tiles = np.flatnonzero(duotone.joined == kind)
        coarse = tile_template(rings=rings, resolution=resolution, yellow_joined=kind)
        fine = tile_template(rings=rings, resolution=2 * resolution, yellow_joined=kind)
        ends, middles = _edges(coarse, fine)
        uv = np.concatenate([coarse.uv, middles])
        rows = np.arange(len(tiles) * len(uv)).reshape(len(tiles), len(uv))
        operator = limit.operator([Samples(tiles, uv, rows)], size=rows.size)
        found = operator.positions(limit.control)[rows]
        samples = len(coarse.uv)
        a, b = found[:, ends[:, 0]], found[:, ends[:, 1]]
        errors.append(_chord_distance(a, b, found[:, samples:]).ravel())
    return np.concatenate(errors)


def _edges(coarse: TileTemplate, fine: TileTemplate) -> tuple[Indices, Floats]:
    """Return the template's edges and the parameters of their true middles; on arcs, of the curve's."""
    t = coarse.triangles
    ends = np.unique(np.sort(np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]), axis=1), axis=0)
    middles = coarse.uv[ends].mean(axis=1)
    on_arc = np.stack([coarse.arcs[..., :-1].ravel(), coarse.arcs[..., 1:].ravel()], axis=1)
    on_arc.sort(axis=1)
    samples = len(coarse.uv)
    place = np.searchsorted(ends @ [samples, 1], on_arc @ [samples, 1])
    middles[place] = fine.uv[fine.arcs[..., 1::2].ravel()]
    return ends, middles


def _chord_distance(a: Floats, b: Floats, point: Floats) -> Floats:
    """Return the distance of points to the lines through a and b."""
    along = b - a
    length = np.linalg.norm(along, axis=-1)
    away = np.linalg.norm(np.cross(along, point - a), axis=-1)
    distance: Floats = away / np.maximum(length, np.finfo(float).tiny)
    return distance
