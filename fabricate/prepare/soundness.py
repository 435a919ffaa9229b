"""Whether cells may stand for a surface: closed, of the same genus, free of crossings, and near to it everywhere."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.errors import MeshError
from fabricate.mesh.closed import checked_closed, genus
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.triangle_mesh import TriangleMesh, fanned
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.search_tree import SearchTree

SHARE_WITHIN = 0.998
"""Cells stand for a surface when this share of its points is within reach of them."""


def fault(cells: PolygonMesh, *, handles: int) -> str | None:
    """Return what keeps cells from being one closed surface of a genus that does not cross itself, or None."""
    wrong = topology_fault(cells, handles=handles)
    if wrong is not None:
        return wrong
    crossing = len(crossing_faces(cells))
    return f"{crossing} triangles of the cells cross each other" if crossing else None


def topology_fault(cells: PolygonMesh, *, handles: int) -> str | None:
    """Return what keeps cells from being one closed surface of a genus, or None."""
    try:
        found = genus(checked_closed(cells))
    except MeshError as error:
        return str(error)
    return None if found == handles else f"the genus became {found} instead of {handles}"


def crossing_faces(cells: PolygonMesh) -> Indices:
    """Return the triangles, as fans round the means of polygons, that cross or overlap others, (k,) int."""
    triangles = fanned(cells)
    return np.unique(crossing_triangles(triangles.points, triangles.triangles))


def distances(cells: PolygonMesh, places: Floats) -> Floats:
    """Return the distance of each place, (k, 3), from the cells, (k,) float, mm."""
    triangles = fanned(cells)
    return SearchTree.of(triangles.points, triangles.triangles).nearest(places).distance


def lost(cells: PolygonMesh, surface: TriangleMesh, *, reach: float) -> Mask:
    """Return which points of a surface, (n,) bool, are further than `reach`, mm, from the cells; none if few are."""
    far = distances(cells, surface.points) > reach
    few = np.count_nonzero(far) <= (1.0 - SHARE_WITHIN) * len(far)
    return np.zeros_like(far) if few else far
