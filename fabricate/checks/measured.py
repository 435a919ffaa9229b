"""Facts about the surface and the pattern on it, for the report and for what the parts are expected to be."""

from __future__ import annotations

from types import MappingProxyType

import numpy as np

from fabricate.checks.expectations import Expectations, Neck, Spaces
from fabricate.checks.facts import ByColour, Distance, MeshFacts, PatternFacts, Spread
from fabricate.duotone.certificate import Certificate
from fabricate.duotone.duotone import Duotone
from fabricate.mesh.closed import genus
from fabricate.prepare.prepared import Prepared
from fabricate.prepare.tile_quality import tile_quality
from fabricate.prepare.triangle_mesh import TriangleMesh
from fabricate.process import Process
from fabricate.solid.assembly import Assembly, Core
from fabricate.surface.cut import CutSurface
from fabricate.surface.deviation import deviation
from fabricate.surface.neck import tile_necks
from fabricate.surface.sizing import typical_side
from fabricate.surface.tiling import Tiling


def mesh_facts(body: Prepared, tiling: Tiling, surface: CutSurface) -> MeshFacts:
    """Return what is known of the mesh that was divided, and of the finished outer surface."""
    x, y, z = (float(side) for side in np.ptp(surface.points, axis=0))
    return MeshFacts(
        vertices=len(body.mesh.points),
        faces=len(body.mesh.offsets) - 1,
        genus=genus(body.mesh),
        size_mm=(x, y, z),
        repairs=MappingProxyType({action.name: action.count for action in body.actions}),
        notes=body.notes + tiling.notes,
        distance_mm=None if tiling.surface is None else _distance(tiling.surface, surface),
    )


def _distance(whole: TriangleMesh, surface: CutSurface) -> Distance:
    found = deviation(surface.points, surface.triangles, whole.points, whole.triangles)
    x, y, z = (float(value) for value in found.at)
    return Distance(found.mean, found.p999, found.max, (x, y, z))


def pattern_facts(duotone: Duotone, certificate: Certificate, surface: CutSurface) -> PatternFacts:
    """Return what was counted and measured of the pattern on the cut surface."""
    corners = surface.points[surface.triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    share = float(area[surface.yellow].sum() / area.sum())
    curve = surface.points[surface.curve]
    length = float(np.linalg.norm(np.roll(curve, -1, axis=0) - curve, axis=1).sum())
    necks = tile_necks(surface)[0]
    return PatternFacts(
        tiles=len(duotone.joined),
        tile_size_mm=typical_side(duotone.quads),
        tile_quality=tile_quality(duotone.quads.points[duotone.quads.tiles]),
        curves=certificate.curves,
        regions=certificate.yellow.components + certificate.blue.components,
        curve_length_mm=length,
        area_share=ByColour(share, 1.0 - share),
        handles=ByColour(certificate.yellow.handles, certificate.blue.handles),
        neck_mm=Spread(float(necks.min()), float(np.median(necks))),
    )


def expectations(
    surface: CutSurface,
    solids: Assembly,
    certificate: Certificate,
    *,
    clearance: float,
    core: Core,
    process: Process | None = None,
) -> Expectations:
    """Return what the two parts of these solids should be, when they are read back from their files."""
    necks, places = tile_necks(surface)
    x, y, z = (float(value) for value in places[necks.argmin()])
    gap, shell = solids.spaces
    return Expectations(
        clearance=clearance,
        genus=expected_genus(certificate.yellow.handles, certificate.blue.handles, core=core),
        process=process,
        neck=Neck(float(necks.min()), (x, y, z)),
        spaces=Spaces(gap, shell),
    )


def expected_genus(yellow: int, blue: int, *, core: Core) -> dict[str, int]:
    """Return the handles of each solid, from those of its region.

    A region thickened is bounded by two copies of itself: twice its handles. A part with a core is bounded by
    its own region and a copy of the other one: the genus of the whole.
    """
    return {
        "yellow": yellow + blue if core == "yellow" else 2 * yellow,
        "blue": yellow + blue if core == "blue" else 2 * blue,
    }
