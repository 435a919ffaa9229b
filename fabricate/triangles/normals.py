"""Normals of a triangle mesh: of its triangles, and at its points."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices


def area_vectors(points: Floats, triangles: Indices) -> Floats:
    """Return for each triangle its normal as long as twice its area, (m, 3) float, mm2."""
    first, second, third = (points[triangles[:, k]] for k in range(3))
    vectors: Floats = np.cross(second - first, third - first)
    return vectors


def point_areas(points: Floats, triangles: Indices) -> Floats:
    """Return a third of the area of the triangles at each point, (n,) float, mm2."""
    share = np.linalg.norm(area_vectors(points, triangles), axis=1) / 6.0
    return np.asarray(np.bincount(triangles.ravel(), np.repeat(share, 3), minlength=len(points)), dtype=np.float64)


def vertex_normals(points: Floats, triangles: Indices) -> Floats:
    """Return area-weighted unit normals, (n, 3) float."""
    facet = area_vectors(points, triangles)
    normals = np.zeros_like(points)
    for axis in range(3):
        normals[:, axis] = sum(np.bincount(triangles[:, k], facet[:, axis], minlength=len(points)) for k in range(3))
    return unit(normals)


def mean_normals(points: Floats, triangles: Indices) -> Floats:
    """Return the unit means of the unit normals of the triangles at each point, (n, 3) float: slivers count in full."""
    facet = unit(area_vectors(points, triangles))
    corners = triangles.ravel()
    columns = [np.bincount(corners, np.repeat(axis, 3), minlength=len(points)) for axis in facet.T]
    return unit(np.stack(columns, axis=1))


def unit(vectors: Floats) -> Floats:
    """Return the vectors, (n, 3), at length 1; a zero vector stays zero."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    scaled: Floats = vectors / np.maximum(length, np.finfo(float).tiny)
    return scaled
