"""Whether cells may stand for a surface: closed, of the same genus, free of crossings, and near to it everywhere.

And without bridges, which lead across a narrow gap from one part of a body to another where the surface does not.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import dijkstra

from fabricate.arrays import Floats, Indices, Mask
from fabricate.errors import MeshError
from fabricate.mesh.closed import checked_closed, genus
from fabricate.mesh.edges import Edges
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.triangle_mesh import TriangleMesh, edges, fanned
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.search_tree import SearchTree

SHARE_WITHIN = 0.998
"""Cells stand for a surface when this share of its points is within reach of them."""

DETOUR = 2.0
"""An edge is a bridge when the way between its ends along the surface is this many times as long as cells are."""

SOURCES = 200
"""Ways are looked for from so many points at once: each takes a row as long as the surface has points."""


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


def bridges(cells: PolygonMesh, surface: TriangleMesh, *, span: float) -> Indices:
    """Return the edges of cells, (k, 2) int, between places that are far from each other along the surface.

    Edges shorter than `span`, the side that cells should have, mm, count as that long. Ways lead along the edges of
    the surface, which has to be finer than the cells.
    """
    ends = Edges.of(cells).ends
    near = _nearest_points(surface, cells.points)
    joined = edges(surface)
    count = len(surface.points)
    ways = csr_array(coo_array((joined.lengths(surface.points), tuple(joined.ends.T)), shape=(count, count)))
    length = np.maximum(np.linalg.norm(cells.points[ends[:, 0]] - cells.points[ends[:, 1]], axis=1), span)
    limit = DETOUR * float(length.max())
    sources, source_of = np.unique(near[ends[:, 0]], return_inverse=True)
    along = np.zeros(len(ends))
    for begin in range(0, len(sources), SOURCES):
        own = np.flatnonzero((source_of >= begin) & (source_of < begin + SOURCES))
        reached = dijkstra(ways, directed=False, indices=sources[begin : begin + SOURCES], limit=limit)
        along[own] = reached[source_of[own] - begin, near[ends[own, 1]]]
    found: Indices = ends[along > DETOUR * length]
    return found


def _nearest_points(surface: TriangleMesh, places: Floats) -> Indices:
    """Return for each place, (k, 3), the nearest corner of the nearest triangle, (k,) int."""
    found = SearchTree.of(surface.points, surface.triangles).nearest(places)
    corners = surface.triangles[found.triangle]
    distance = np.linalg.norm(surface.points[corners] - places[:, None], axis=2)
    nearest: Indices = corners[np.arange(len(corners)), distance.argmin(axis=1)]
    return nearest
