"""What is wrong with an assembly, found exactly, and which surface points it comes from."""

from __future__ import annotations

import igl
import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.solid.assembly import Assembly
from fabricate.solid.crossing import crossing_triangles, triangles_near

GAP_SHARE = 0.965
"""A gap below this share of the clearance is a fault here; the promise to the user is 0.95."""

ALONG_EDGE = np.array([[0.75, 0.25], [0.5, 0.5], [0.25, 0.75]])
"""Where edges longer than the clearance are measured, as weights of their ends."""


def crossing_points(assembly: Assembly, *, clearance: float, moved: Mask) -> Mask:
    """Return the surface points, (n,) bool, under triangles that cross; only near `moved` points, (n,) bool.

    Crossings among triangles of the outer surface alone are left out: no inner surface cures those.
    """
    n = assembly.surface_points
    triangles = np.concatenate([assembly.yellow, assembly.blue])
    if clearance == 0.0:  # the parts share their walls: look at each of those once
        triangles = triangles[np.unique(np.sort(triangles, axis=1), axis=0, return_index=True)[1]]
    if not moved.all():
        everywhere = np.tile(moved, len(assembly.points) // n)
        triangles = triangles[triangles_near(assembly.points, triangles, everywhere)]
    pairs = crossing_triangles(assembly.points, triangles)
    inside = ~_outer(assembly, clearance)[triangles].all(axis=1)
    return _surface_points(assembly, triangles[pairs[inside[pairs].any(axis=1)]].ravel())


def near_points(assembly: Assembly, *, clearance: float) -> Mask:
    """Return the surface points, (n,) bool, under which the parts are nearer than the clearance allows.

    Each part is measured at its points, and along its long edges where these could come too near: a point of an
    edge is no nearer than half of what its ends' distances add up to beyond its length.
    """
    least = GAP_SHARE * clearance
    near = []
    for own, other in ((assembly.yellow, assembly.blue), (assembly.blue, assembly.yellow)):
        numbers = np.unique(own)
        distance = np.full(len(assembly.points), np.inf)
        distance[numbers] = distances(assembly.points[numbers], assembly.points, other)
        near.append(numbers[distance[numbers] < least])
        edges = np.concatenate([own[:, [0, 1]], own[:, [1, 2]], own[:, [2, 0]]])
        edges = edges[edges[:, 0] < edges[:, 1]]
        ends = assembly.points[edges]
        length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        close = (length > clearance) & (distance[edges].sum(axis=1) - length < 2.0 * least)
        samples = np.einsum("sk,ekj->esj", ALONG_EDGE, ends[close])
        found = distances(samples.reshape(-1, 3), assembly.points, other).reshape(samples.shape[:2])
        near.append(edges[close][(found < least).any(axis=1)].ravel())
    numbers = np.concatenate(near)
    return _surface_points(assembly, numbers[~_outer(assembly, clearance)[numbers]])


def distances(queries: Floats, points: Floats, triangles: Indices) -> Floats:
    """Return the distance of each query point to a triangle mesh, (q,) float, mm."""
    tree = igl.AABB()
    tree.init(points, triangles)
    squared = tree.squared_distance(points, triangles, np.ascontiguousarray(queries))[0]
    return np.sqrt(np.asarray(squared, dtype=np.float64))


def _surface_points(assembly: Assembly, numbers: Indices) -> Mask:
    points: Mask = np.zeros(assembly.surface_points, dtype=bool)
    points[numbers % assembly.surface_points] = True
    return points


def _outer(assembly: Assembly, clearance: float) -> Mask:
    """Return which numbers lie on the outer layer: block 0, and with a clearance blue's copy in block 2."""
    block = np.arange(len(assembly.points)) // assembly.surface_points
    outer: Mask = (block == 0) | ((block == 2) & (clearance > 0.0))
    return outer
