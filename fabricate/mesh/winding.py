"""Winding of faces: flipping them, and which ones to flip."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Mask
from fabricate.mesh.edges import Sheets
from fabricate.mesh.polygon_mesh import PolygonMesh


def flipped(mesh: PolygonMesh, faces: Mask) -> PolygonMesh:
    """Return the mesh with the faces, (f,) bool, wound the other way, each beginning with the same corner."""
    begins = mesh.offsets[mesh.face_of_corner]
    sizes = mesh.face_sizes[mesh.face_of_corner]
    places = np.arange(len(mesh.corners)) - begins
    turned = faces[mesh.face_of_corner]
    corner = begins + np.where(turned, -places % sizes, places)
    half_edge = begins + np.where(turned, (-places - 1) % sizes, places)
    return PolygonMesh(mesh.points, mesh.corners[corner], mesh.offsets, mesh.creases[half_edge])


def fewest_flips(covers: Sheets) -> Mask:
    """Return the faces, (f,) bool, whose flipping makes every orientable part wound consistently.

    Of the two halves of a part the smaller one is flipped, of equal halves the one without the first face.
    Non-orientable parts are left alone.
    """
    upper, lower = covers
    part = np.minimum(upper, lower)
    in_first = upper < lower
    sizes = np.bincount(part)
    firsts = np.bincount(part, weights=in_first, minlength=len(sizes))
    head = np.zeros(len(sizes), dtype=bool)
    head[part[::-1]] = in_first[::-1]
    keep_first = np.where(2 * firsts == sizes, head, 2 * firsts > sizes)
    flips: Mask = (in_first != keep_first[part]) & ~covers.one_sided
    return flips
