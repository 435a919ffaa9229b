"""Triangles or hexagons as large as asked for, and smaller only where the shape would be lost otherwise."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from fabricate.arrays import Indices, Mask
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.isotropic import isotropic
from fabricate.prepare.sizing_field import SizingField
from fabricate.prepare.soundness import crossing_faces, lost
from fabricate.prepare.triangle_mesh import TriangleMesh, fanned
from fabricate.triangles.search_tree import SearchTree

MOST_FITS = 12
"""Times that cells are made. Ten are enough for a boot with a thin shell and 12 handles, one for most shapes."""


def fitted(
    surface: TriangleMesh,
    *,
    length: float,
    reach: float,
    cells_of: Callable[[TriangleMesh], PolygonMesh],
    seed: int,
) -> PolygonMesh:
    """Return cells on a surface, made of triangles with edges of `length` mm, shorter in thin and bent places.

    Edges are asked to be shorter where points of the surface are further than `reach` mm from the cells and where
    cells cross, and everything is made anew: a tip that is lost would not come back by refining. Of all cells made
    those with the fewest crossings, and then with the fewest points lost, are returned; mostly that is none.

    Parameters
    ----------
    surface : TriangleMesh
        Closed, with edges well below `length`.
    cells_of : callable
        From triangles to cells: their polygons, or the dual.
    seed : int
        Which of neighbouring edges is collapsed first is half chance.
    """
    field = SizingField.even(surface, length=length)
    best, best_faults = None, (0, 0)
    for _ in range(MOST_FITS):
        cells = cells_of(isotropic(field, start=surface, seed=seed))
        crossing, missing = crossing_faces(cells), lost(cells, surface, reach=reach)
        faults = len(crossing), int(missing.sum())
        if best is None or faults < best_faults:
            best, best_faults = cells, faults
        if faults == (0, 0):
            break
        field = field.refined(missing | _near(cells, crossing, field))
    return cells if best is None else best


def _near(cells: PolygonMesh, faces: Indices, field: SizingField) -> Mask:
    """Return which points of the surface are within an edge's length of some triangles of the cells, (n,) bool."""
    if not len(faces):
        return np.zeros(len(field.lengths), dtype=bool)
    triangles = fanned(cells)
    tree = SearchTree.of(triangles.points, triangles.triangles[faces])
    near: Mask = tree.nearest(field.surface.points).distance < field.lengths
    return near
