"""A cube made of squares."""

from __future__ import annotations

import numpy as np

from fabricate.errors import MeshError
from fabricate.mesh.polygon_mesh import PolygonMesh


def cube(*, divisions: int) -> PolygonMesh:
    """Return the cube [-1, 1]^3 with each side divided into `divisions` x `divisions` squares.

    The mesh has 6 d^2 + 2 points, shared between the sides, and 6 d^2 quads. Its Catmull-Clark limit is a
    cube with rounded edges; more divisions make them sharper.

    Raises
    ------
    MeshError
        If `divisions` is below 1.
    """
    if divisions < 1:
        raise MeshError(f"cube: divisions must be 1 or more, found {divisions}: choose 1, 2, 3, ...")
    i, j = (grid.ravel() for grid in np.meshgrid(np.arange(divisions), np.arange(divisions), indexing="ij"))
    u, v = np.stack([i, i + 1, i + 1, i], axis=1), np.stack([j, j, j + 1, j + 1], axis=1)
    low, high = np.zeros_like(u), np.full_like(u, divisions)
    tops = [np.stack(axes, axis=-1) for axes in ((u, v, high), (high, u, v), (v, high, u))]
    bottoms = [np.stack(axes, axis=-1) for axes in ((v, u, low), (low, v, u), (u, low, v))]
    nodes = np.concatenate(tops + bottoms).reshape(-1, 3)
    lattice, corners = np.unique(nodes, axis=0, return_inverse=True)
    points = (2 * lattice - divisions).astype(np.float64) / divisions
    return PolygonMesh(points, corners.ravel(), np.arange(0, len(nodes) + 1, 4))
