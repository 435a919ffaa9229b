"""The inner surface: one point under every point of the outer one, as deep as the wall is thick.

Straight down by the thickness folds wherever the surface bends more sharply than that, or the body is thinner than two
walls. So the ways in are evened out over the surface, and the depth is capped where the body is thin. Where an exact
test finds a fault all the same, the inner points around it slide sideways to where there is room and are relaxed, that
is moved towards the mean of their neighbours, which opens a fold without thinning the wall. What this does not cure
has to retreat (see `solid.retreat`).
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from fabricate.arrays import Floats, Indices, Mask
from fabricate.surface.cut import CutSurface
from fabricate.surface.mitre import Mitred, ways_out
from fabricate.surface.smoothing import diffused
from fabricate.triangles.adjacency import grown, undirected_edges
from fabricate.triangles.normals import area_vectors, mean_normals, unit
from fabricate.triangles.ray_casting import first_hits

DEPTH_SLOPE = 0.7
"""A capped depth may change by this much per mm along the surface."""

START = 1e-3
"""How far under the surface a ray begins, mm, so that it does not hit where it comes from."""

SLOPE_PASSES = 30
EVENED, LEAST_UPRIGHT = 2.5, 0.7
"""Over how many thicknesses normals are evened out, and the smallest cosine of a leaning way that is made up for.

At an edge of 90 degrees ways turn by 0.57 / thickness: by less than 1 / thickness nothing folds."""

RINGS, SWEEPS = 3, 3
"""How far around a fault points are relaxed, in edges, and how often in a round."""

TURNS, TURN = 30, 0.2
"""How often the way down is turned where it is too shallow, and by how much."""

LEAST_STEEP = 0.3
"""Least cosine between the way down and that of each triangle around a point."""

TILES, SLIDES = 1, 36
"""How far around a fault points slide, in tiles, and how often in a round."""


def ways_in(surface: CutSurface, *, thickness: float) -> Floats:
    """Return the ways by which points move in for each mm of depth, (n, 3); longer than 1 where they lean.

    The normals of a sharp bend would lead to a fold. So a way is the normal evened out over the surface, by which
    it leans where the surface bends, and as long as it takes to be as deep under the surface there. Surfaces with
    creases have ways of their own (see `surface.mitre`).
    """
    if (surface.mitre > 1.0).any():
        mitred = Mitred(surface.normals, surface.mitre, surface.along)
        return -ways_out(surface.points, surface.triangles, mitred, depth=thickness)
    even = unit(diffused(surface.normals, surface.base, surface.triangles, length=EVENED * thickness))
    upright = np.einsum("ij,ij->i", even, surface.normals)[:, None]
    longer = 1.0 / np.maximum(upright, LEAST_UPRIGHT)
    ways: Floats = -even * diffused(longer, surface.base, surface.triangles, length=thickness)
    return ways


def downward(points: Floats, triangles: Indices, ways: Floats) -> Floats:
    """Return the ways into the body from each point, (n, 3), turned where they do not go in.

    Where a coarse tessellation bends so sharply that a way hardly goes through one of the triangles around a
    point, or not at all, it turns towards those triangles' own until it goes in through all of them, if there is
    such a way.
    """
    facets = unit(area_vectors(points, triangles))
    length = np.linalg.norm(ways, axis=1, keepdims=True)
    way: Floats = unit(ways)
    for _ in range(TURNS):
        shallow = -np.einsum("ij,ikj->ik", facets, way[triangles]) < LEAST_STEEP
        if not shallow.any():
            break
        pull = np.zeros_like(way)
        for k in range(3):
            np.add.at(pull, triangles[shallow[:, k], k], -facets[shallow[:, k]])
        way = unit(way + TURN * unit(pull))
    turned: Floats = length * way
    return turned


def straight_down(points: Floats, triangles: Indices) -> Floats:
    """Return the unit ways into a body that go in through all triangles at each point, if any do, (n, 3)."""
    return downward(points, triangles, -mean_normals(points, triangles))


def ways_through(surface: CutSurface, ways: Floats) -> Floats:
    """Return how far it is from each point along its way, (n, 3), to where that leaves the body, (n,) mm."""
    inward = unit(ways)
    return first_hits(surface.points, surface.triangles, surface.points + START * inward, inward).distance


def capped_depth(surface: CutSurface, ways: Floats, *, thickness: float | Floats, between: float) -> Floats:
    """Return the depth of each inner point, (n,) mm: the thickness, (n,) or one for all, less where the body is thin.

    `ways`, (n, 3), are those by which a point moves in for each mm of depth, longer than 1 at sharp edges. Where
    the way through the body is shorter than two walls and `between`, the two inner
    surfaces keep `between` mm from each other. The depth changes gently from point to point.
    """
    through = ways_through(surface, ways) / np.linalg.norm(ways, axis=1)
    thickness = np.broadcast_to(thickness, through.shape)
    depth: Floats = np.clip((through - between) / 2.0, 0.1 * thickness, thickness)
    if (depth < thickness).any():
        ends = undirected_edges(surface.triangles)
        span = np.linalg.norm(surface.points[ends[:, 0]] - surface.points[ends[:, 1]], axis=1) * DEPTH_SLOPE
        for _ in range(SLOPE_PASSES):
            reach = depth[ends] + span[:, None]
            np.minimum.at(depth, ends[:, 0], reach[:, 1])
            np.minimum.at(depth, ends[:, 1], reach[:, 0])
    return depth


def spread(surface: CutSurface, inner: Floats, faulty: Mask, means: csr_array) -> Floats:
    """Return the inner points, those over the tiles around the faulty ones slid sideways at their depth.

    Points gather at a fold. Sliding towards the mean of their neighbours hands the crowding on to where there is
    room, without changing the thickness. Under creases points only slide along these.
    """
    wide = np.flatnonzero(grown(faulty, means, TILES * (surface.rays.shape[2] - 1)))
    rows, normals = means[wide], surface.normals[wide]
    sharp, along = (surface.mitre > 1.0)[wide, None], surface.along[wide]
    inner = inner.copy()
    for _ in range(SLIDES):
        way = rows @ inner - inner[wide]
        aside = way - np.einsum("ij,ij->i", way, normals)[:, None] * normals
        inner[wide] += np.where(sharp, np.einsum("ij,ij->i", way, along)[:, None] * along, aside)
    return inner


def relaxed(surface: CutSurface, inner: Floats, faulty: Mask, means: csr_array) -> Floats:
    """Return the inner points, those close to the faulty ones moved to the mean of their neighbours.

    Points under creases only move along these.
    """
    around = grown(faulty, means, RINGS)[:, None]
    sharp = (surface.mitre > 1.0)[:, None]
    for _ in range(SWEEPS):
        way = means @ inner - inner
        kept = np.einsum("ij,ij->i", way, surface.along)[:, None] * surface.along
        inner = inner + np.where(around, np.where(sharp, kept, way), 0.0)
    return inner
