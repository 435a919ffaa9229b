"""The inner surface: one point under every point of the outer one, as deep as the wall is thick.

Straight down by the thickness folds wherever the surface bends more sharply than that, or the body is thinner than two
walls. So the depth is capped where the body is thin, and where an exact test finds a fault the inner points around it
slide sideways to where there is room and are relaxed: moved towards the mean of their neighbours, which opens a fold
without thinning the wall. Only what this does not cure is moved back towards the surface.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from fabricate.arrays import Floats, Indices, Mask
from fabricate.surface.cut import CutSurface
from fabricate.triangles.adjacency import grown
from fabricate.triangles.ray_casting import first_hits

DEPTH_SLOPE = 0.7
"""A capped depth may change by this much per mm along the surface."""

SLOPE_PASSES = 30
RINGS, SWEEPS = 3, 3
"""How far around a fault points are relaxed, in edges, and how often in a round."""

TILES, SLIDES = 1, 36
"""How far around a fault points slide, in tiles, and how often in a round."""

RETREAT = 0.4
"""Share of the way back to a safe depth that points near a stubborn fault move in a round."""

SAFE_DEPTH = 0.03
"""The safe depth, as a share of the capped one."""


def capped_depth(surface: CutSurface, *, thickness: float, between: float) -> Floats:
    """Return the depth of each inner point, (n,) mm: the thickness, less where the body is thin.

    Where the straight way through the body is shorter than two walls and `between`, the two inner
    surfaces keep `between` mm from each other. The depth changes gently from point to point.
    """
    start = surface.points - 1e-3 * surface.normals
    through = first_hits(surface.points, surface.triangles, start, -surface.normals).distance
    depth: Floats = np.clip((through - between) / 2.0, 0.1 * thickness, thickness)
    if (depth < thickness).any():
        ends = _edges(surface.triangles)
        span = np.linalg.norm(surface.points[ends[:, 0]] - surface.points[ends[:, 1]], axis=1) * DEPTH_SLOPE
        for _ in range(SLOPE_PASSES):
            reach = depth[ends] + span[:, None]
            np.minimum.at(depth, ends[:, 0], reach[:, 1])
            np.minimum.at(depth, ends[:, 1], reach[:, 0])
    return depth


def slid(surface: CutSurface, inner: Floats, faulty: Mask, means: csr_array) -> Floats:
    """Return the inner points, those over the tiles around the faulty ones slid sideways at their depth.

    Points gather at a fold; sliding towards the mean of the neighbours hands the crowding on to where there is
    room, without changing the thickness.
    """
    wide = np.flatnonzero(grown(faulty, means, TILES * (surface.rays.shape[2] - 1)))
    rows, normals = means[wide], surface.normals[wide]
    inner = inner.copy()
    for _ in range(SLIDES):
        way = rows @ inner - inner[wide]
        inner[wide] += way - np.einsum("ij,ij->i", way, normals)[:, None] * normals
    return inner


def relaxed(inner: Floats, faulty: Mask, means: csr_array) -> Floats:
    """Return the inner points, those close to the faulty ones moved to the mean of their neighbours."""
    around = grown(faulty, means, RINGS)[:, None]
    for _ in range(SWEEPS):
        inner = np.where(around, means @ inner, inner)
    return inner


def retreated(surface: CutSurface, inner: Floats, faulty: Mask, means: csr_array, *, safe: Floats) -> Floats:
    """Return the inner points around the faulty ones moved part of the way to `safe`, (n, 3).

    A ray with a faulty point moves as a whole, because the clearance is made along it.
    """
    around = faulty.copy()
    around[surface.rays[faulty[surface.rays].any(axis=2)]] = True
    weight = grown(around, means, 1).astype(np.float64)
    for _ in range(RINGS):
        weight = np.maximum(weight, means @ weight)
    return inner + RETREAT * weight[:, None] * (safe - inner)


def _edges(triangles: Indices) -> Indices:
    """Return each undirected edge of a closed mesh once, (e, 2) int."""
    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return ends[ends[:, 0] < ends[:, 1]]
