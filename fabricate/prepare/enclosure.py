"""What repair by wrapping chooses: lids on small holes, how fine the wrap is, and how far from the surface."""

from __future__ import annotations

import numpy as np

from fabricate.mesh.closed import check_closed_manifold, signed_volume
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.capping import lids
from fabricate.prepare.ear_clipping import ear_clipped
from fabricate.prepare.repaired import Action, Repaired
from fabricate.prepare.thinnest import thicknesses
from fabricate.prepare.unit_box import UnitBox
from fabricate.prepare.wrap import finite_triangles, from_triangles, wrapped
from fabricate.triangles.normals import area_vectors

WRAPPED = "surfaces wrapped"
"""Name of what is done, by which others tell that the surface is a new one."""

OFFSET = 0.002
"""Distance of the wrap from a body, as a share of the diagonal: 0.3 mm on a diagonal of 150 mm, about a layer.
A smaller one takes longer and fills creases with small triangles."""

SHEET_OFFSET = 0.02
"""The same for sheets, which become twice as thick: 6 mm on a diagonal of 150 mm, enough for two walls and a gap."""

SHEET_ALPHA = 2 * SHEET_OFFSET
"""Gaps between sheets that are narrower than these are thick are bridged."""

FINEST, COARSEST = 0.01, 0.02
"""Bounds of alpha. Gaps narrower than 1 % of the diagonal are bridged: no tool of a duotone's size gets into them."""

MOST_TRIANGLES = 24_000
"""Alpha is made coarser, within its bounds, until about so many are expected: the time grows with their number."""

SHEET, SHEETS = 3.0, 0.01
"""Of a sheet the wrap is two offsets thick. There are sheets when this share of its surface is thinner than so many."""

_DENSITY = 1.4
"""Triangles of a wrap per area in units of alpha squared, as counted on scans."""


def enclosed(mesh: PolygonMesh) -> Repaired:
    """Return the alpha wrap of a mesh in any state: closed, free of crossings, and slightly larger.

    Small holes get lids first, as otherwise the wrap would line the inside, too. If parts of the wrap turn out to be
    no thicker than the skin round a sheet, all is wrapped again, further out.

    Raises
    ------
    MeshError
        If the mesh has no area.
    PrepareError
        If PyMeshLab or libraries that it needs are missing.
    """
    triangles = finite_triangles(mesh.points, ear_clipped(mesh).triangles)
    box = UnitBox.of(mesh.points[triangles].reshape(-1, 3))
    bare = from_triangles(box.placed(mesh.points), triangles)
    points, covers, closed = lids(bare)
    whole, alpha = np.concatenate([triangles, covers]), _alpha(bare)
    wrap = wrapped(points, whole, alpha=alpha, offset=OFFSET)
    if _share_of_sheets(wrap) > SHEETS:
        wrap = wrapped(points, whole, alpha=SHEET_ALPHA, offset=SHEET_OFFSET)
    check_closed_manifold(wrap)
    done = (Action("holes closed by lids", closed), Action(WRAPPED, 1))
    return Repaired(wrap.moved(box.restored(wrap.points)), tuple(action for action in done if action.count))


def _alpha(mesh: PolygonMesh) -> float:
    """Return alpha for triangles in the unit box, of which both sides may be wrapped."""
    return float(np.clip(np.sqrt(_DENSITY * 2 * _area(mesh) / MOST_TRIANGLES), FINEST, COARSEST))


def is_sheet(body: PolygonMesh) -> bool:
    """Tell whether a plate with a closed body's volume and area is hardly thicker than the skin round a sheet."""
    diagonal = float(np.linalg.norm(np.ptp(body.points, axis=0)))
    areas = np.linalg.norm(area_vectors(body.points, ear_clipped(body).triangles), axis=1) / 2
    return 2 * abs(signed_volume(body)) < SHEET * OFFSET * diagonal * float(areas.sum())


def _share_of_sheets(wrap: PolygonMesh) -> float:
    """Return the share of a wrap, in the unit box, behind which it is hardly thicker than the skin round a sheet."""
    triangles = wrap.corners.reshape(-1, 3)
    areas = np.linalg.norm(area_vectors(wrap.points, triangles), axis=1)
    thin = thicknesses(wrap.points, triangles) < SHEET * OFFSET
    return float(areas[thin].sum() / areas.sum())


def _area(mesh: PolygonMesh) -> float:
    return float(np.linalg.norm(area_vectors(mesh.points, mesh.corners.reshape(-1, 3)), axis=1).sum() / 2)
