"""Smooth fields on a triangle mesh: gaps filled from around, and detail below a length taken out."""

from __future__ import annotations

import igl
import numpy as np
from scipy.sparse import csr_array, diags_array

from fabricate.arrays import Floats, Indices
from fabricate.surface.conjugate_gradients import solved

REWEIGHTED, AROUND = 3, 4
"""How often trust in values is weighed, and over how many passes what is around them is averaged at least."""

STEEP = 4.0
"""How many times its neighbours' distance a value may stand out from those around it before it loses half its trust."""

CERTAIN, LEAST_TRUST = 0.25, 0.05
"""From which trust on a value stands for itself; and what one that was filled in is trusted."""

FAR = 12
"""Passes over which values without trust are filled in."""


def filled(values: Floats, weight: Floats, means: csr_array, *, passes: int) -> Floats:
    """Return values, (n, 3), smoothed `passes` times, each counting with its weight, (n,) from 0 to 1.

    A value of weight 0 is replaced by what comes from around it, or by 0 if nothing does.
    """
    both = _averaged(np.column_stack([values * weight[:, None], weight]), means, passes)
    filled_in: Floats = both[:, :-1] / np.maximum(both[:, -1:], np.finfo(float).tiny)
    return filled_in


def steadied(values: Floats, weight: Floats, means: csr_array, spacing: Floats, *, passes: int) -> Floats:
    """Return values, (n, 3), smoothed `passes` times, without those that stand out from the values around them.

    Neighbours whose values differ by several times their distance, (n,) float, are hardly neighbours where they
    lead to, so one of them leads astray. Each value counts with its weight, (n,), the less the further it is from the
    mean around it, and what hardly counts is filled in from around.
    """
    trust = weight
    for _ in range(REWEIGHTED):
        around = filled(values, trust, means, passes=max(passes, AROUND))
        off = np.linalg.norm(values - around, axis=1) / (STEEP * spacing)
        trust = weight / (1.0 + off**4)
    share = np.minimum(trust / CERTAIN, 1.0)[:, None]
    mended = share * values + (1.0 - share) * filled(values, trust, means, passes=FAR)
    return filled(mended, np.maximum(trust, LEAST_TRUST), means, passes=passes)


def low_pass(values: Floats, means: csr_array, *, passes: int) -> Floats:
    """Return values, (n, 3), without what varies over fewer than about sqrt(passes) edges.

    What averaging takes away is averaged and given back once, so that broad shapes shrink to second order only.
    """
    smooth = _averaged(values, means, passes)
    kept: Floats = smooth + _averaged(values - smooth, means, passes)
    return kept


def diffused(values: Floats, points: Floats, triangles: Indices, *, length: float) -> Floats:
    """Return values, (n, k), of a closed surface without what varies over less than about `length`, mm.

    One implicit step of the heat equation. It is measured on the surface and not in edges, so it is as thorough
    where points crowd together.
    """
    stiffness = csr_array(igl.cotmatrix(points, triangles))
    areas = csr_array(igl.massmatrix(points, triangles, igl.MASSMATRIX_TYPE_BARYCENTRIC)).diagonal()
    operator = csr_array(diags_array(areas) - (0.5 * length) ** 2 * stiffness)
    return solved(operator, areas[:, None] * values, values, free=lambda change: change)


def passes_over(length: float, edge: float) -> int:
    """Return how many passes spread a value over `length` when edges are `edge` long, both mm.

    A pass goes half of the way to the mean of the neighbours, which spreads a point's value by half an edge in
    each direction (the standard deviation); and spreads add up as squares.
    """
    return max(1, round((length / (0.5 * edge)) ** 2))


def _averaged(values: Floats, means: csr_array, passes: int) -> Floats:
    for _ in range(passes):
        values = 0.5 * (values + means @ values)
    return values
