"""Proof that a cut surface has the curves and regions that it should have, counted from its triangles."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fabricate.arrays import Indices
from fabricate.duotone.certificate import Certificate, RegionFacts
from fabricate.surface.cut import CutSurface


def cut_certificate(surface: CutSurface) -> Certificate:
    """Count curves, components and Euler characteristics of a cut surface; only its triangles are looked at.

    Curves are the connected components of the edges between regions. k rings make k curves and k + 1 connected
    regions: yellow and blue with one boundary circle, and bands with two and an Euler characteristic of 0.
    """
    triangles, regions = surface.triangles, surface.regions
    edges, sides = _edges(triangles, len(surface.points))
    first, second = regions[sides].T
    apart = first != second
    labels = _labels(sides[~apart], len(triangles))
    counted = []
    for region in range(len(surface.crossings) + 1):
        own, beside = regions == region, (first == region) | (second == region)
        points = len(np.unique(triangles[own]))
        euler = points - int(beside.sum()) + int(own.sum())
        components, rims = len(np.unique(labels[own])), _pieces(edges[apart & beside])
        counted.append(RegionFacts(components, euler, (2 * components - rims - euler) // 2))
    whole = len(np.unique(triangles)) - len(edges) + len(triangles)
    return Certificate(_pieces(edges[apart]), tuple(counted), 1 - whole // 2)


def _edges(triangles: Indices, points: int) -> tuple[Indices, Indices]:
    """Return the two points of each edge of a closed surface and the two triangles at it, (e, 2) int each."""
    half_edges = np.stack([triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()], axis=1)
    half_edges.sort(axis=1)
    order = np.argsort(half_edges @ [points, 1], kind="stable").reshape(-1, 2)
    return half_edges[order[:, 0]], order // 3


def _labels(pairs: Indices, count: int) -> Indices:
    """Return the component that each of `count` things lies in when pairs, (p, 2), are joined."""
    graph = coo_array((np.ones(len(pairs), dtype=np.int8), tuple(pairs.T)), shape=(count, count))
    return connected_components(graph, directed=False)[1].astype(np.int64)


def _pieces(edges: Indices) -> int:
    """Return into how many connected pieces edges, (e, 2) int, fall."""
    points, ends = np.unique(edges, return_inverse=True)
    return len(np.unique(_labels(ends.reshape(-1, 2), len(points))))
