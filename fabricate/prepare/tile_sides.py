"""How large the tiles will be that cells become."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats
from fabricate.mesh.half_edges import half_edges
from fabricate.mesh.polygon_mesh import PolygonMesh


def tile_sides(cells: PolygonMesh) -> Floats:
    """Return the mean side of the tile that each corner of a closed mesh becomes, (h,) float, mm.

    The tile lies between its corner, the middles of the two edges there and the mean of the face's corners, which
    is a Catmull-Clark step without smoothing: on cells whose points lie on the surface that is nearer to tiles
    carried onto it than the smoothed ones, which shrink with curvature.
    """
    connectivity = half_edges(cells)
    centres = np.add.reduceat(cells.points[cells.corners], cells.offsets[:-1]) / cells.face_sizes[:, None]
    begins, ends = cells.points[connectivity.tail], cells.points[connectivity.tail[connectivity.following]]
    along = np.linalg.norm(ends - begins, axis=1) / 2.0
    inward = np.linalg.norm((begins + ends) / 2.0 - centres[connectivity.face], axis=1)
    sides: Floats = (along + inward + along[connectivity.preceding] + inward[connectivity.preceding]) / 4.0
    return sides
