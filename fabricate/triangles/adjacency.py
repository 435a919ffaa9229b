"""Edges and neighbourhoods of points on a closed triangle mesh."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array, csr_array

from fabricate.arrays import Floats, Indices, Mask


def undirected_edges(triangles: Indices) -> Indices:
    """Return each edge of a closed, oriented mesh once, (e, 2) int, lower number first."""
    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    rising: Indices = ends[ends[:, 0] < ends[:, 1]]
    return rising


def neighbour_means(triangles: Indices, *, count: int) -> csr_array:
    """Return the (count, count) matrix that takes the mean over the points joined to each point."""
    rows, columns = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).T
    degree = np.bincount(rows, minlength=count)
    return coo_array((1.0 / degree[rows], (rows, columns)), shape=(count, count)).tocsr()


def neighbour_distances(points: Floats, triangles: Indices) -> Floats:
    """Return the mean distance from each point, (n, 3), to those joined to it, (n,) float."""
    corners = points[triangles]
    lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    near = (lengths + np.roll(lengths, 1, axis=1)).ravel()
    counts = np.bincount(triangles.ravel(), minlength=len(points))
    total = np.bincount(triangles.ravel(), near, minlength=len(points))
    distances: Floats = 0.5 * total / np.maximum(counts, 1)
    return distances


def grown(mask: Mask, means: csr_array, rings: int) -> Mask:
    """Return the mask, (n,) bool, with all points within `rings` edges of it."""
    for _ in range(rings):
        mask = mask | (means @ mask.astype(np.float64) > 0.0)
    return mask
