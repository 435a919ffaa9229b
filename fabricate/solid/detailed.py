"""The cut of new cells with the detail of the surface that they were made for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fabricate.duotone.duotone import Duotone
from fabricate.prepare.triangle_mesh import TriangleMesh
from fabricate.solid.settling import settled
from fabricate.surface.cut import CutSurface
from fabricate.surface.detail import carried
from fabricate.surface.detail_resolution import detail_resolution
from fabricate.surface.limit import LimitSurface
from fabricate.surface.resolution import resolution_for
from fabricate.surface.sizing import typical_side

SHARE_WITHIN = 0.95
"""Share of the edges on which the chord tolerance holds before detail is carried. The rest is where the smooth surface
bends sharply, at thin parts and between uneven cells, and there it is not what is made."""


def detailed_cut(
    duotone: Duotone, onto: TriangleMesh, *, rings: Sequence[float], tolerance: float, clearance: float
) -> CutSurface:
    """Cut the limit surface of a duotone, and carry it onto another surface of the same shape and place.

    Fine enough for the chord tolerance of the smooth surface and for the other's detail; all in mm.

    Raises
    ------
    PatternError
        If the rings are out of range or do not increase, or the tolerance would need too many triangles.
    SolidError
        If the clearance does not fit, or the smooth surface crosses itself beyond mending.
    """
    side = typical_side(duotone.quads)
    resolution = max(
        resolution_for(
            duotone, LimitSurface.of(duotone.quads), rings=rings, tolerance=tolerance, share=SHARE_WITHIN, worst=np.inf
        ),
        detail_resolution(onto.points, onto.triangles, tile_side=side),
    )
    surface = settled(duotone, clearance=clearance, rings=rings, resolution=resolution)
    found = carried(surface.points, surface.normals, surface.triangles, onto.points, onto.triangles)
    # the normals of a surface with creases know of these, and it is smooth between them
    normals = surface.normals if (surface.mitre > 1.0).any() else found.base_normals
    return replace(surface, points=found.points, base=found.base, normals=normals)
