"""Repair by policy: from a mesh as it was read to closed components with volume, or an error that says why not."""

from __future__ import annotations

from typing import Literal, TypeAlias

import numpy as np

from fabricate.errors import MeshError
from fabricate.mesh.closed import check_closed_manifold, outward
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.components import split
from fabricate.prepare.crossing_pairs import crossings
from fabricate.prepare.ear_clipping import ear_clipped
from fabricate.prepare.enclosure import enclosed, is_sheet
from fabricate.prepare.gentle import gently_repaired
from fabricate.prepare.repaired import Action, Repaired
from fabricate.prepare.store import NOTHING_KEPT, Kept, Store
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.normals import area_vectors

RepairPolicy: TypeAlias = Literal["none", "gentle", "wrap"]


def repaired(mesh: PolygonMesh, *, policy: RepairPolicy, store: Store = NOTHING_KEPT) -> Repaired:
    """Return a mesh whose components are closed, consistently wound 2-manifolds with volume.

    "none" takes the mesh as it is; "gentle" mends connections and winding without moving a point (see
    `gently_repaired`). "wrap" does that, too, and if components are left that are not closed, cross each other or
    themselves, or are as thin as sheets, puts an alpha wrap round everything (see `enclosed`), which is a new surface
    and is kept in the store.

    Raises
    ------
    MeshError
        If a fault is left; the message says which and where, and which policy would cure it.
    PrepareError
        If the mesh has to be wrapped and PyMeshLab or libraries that it needs are missing.
    """
    if policy == "none":
        found = Repaired(mesh, ())
    else:
        found = gently_repaired(mesh)
        if policy == "wrap" and not _is_sound(found.mesh):
            around = _enclosed(found.mesh, store)
            found = Repaired(around.mesh, found.actions + around.actions)
    fault = _fault(found.mesh)
    if fault:
        raise MeshError(fault + _advice(mesh, policy))
    return found


def _enclosed(mesh: PolygonMesh, store: Store) -> Repaired:
    def make() -> Kept:
        made = enclosed(mesh)
        return Kept(made.mesh, tuple(f"{action.count} {action.name}" for action in made.actions))

    kept = store.recalled(mesh, "wrap", make)
    actions = (words.split(" ", 1) for words in kept.words)
    return Repaired(kept.mesh, tuple(Action(name, int(count)) for count, name in actions))


def _fault(mesh: PolygonMesh) -> str:
    """Return what keeps a mesh from being closed components with volume, or nothing."""
    try:
        check_closed_manifold(mesh)
        for part in split(mesh):
            outward(part)
    except MeshError as error:
        return str(error)
    return ""


def _is_sound(mesh: PolygonMesh) -> bool:
    """Return whether all components are closed, with volume, not all mere sheets, and no two triangles cross."""
    return not _fault(mesh) and not _crosses(mesh) and not _is_sheets(mesh)


def _is_sheets(mesh: PolygonMesh) -> bool:
    return all(is_sheet(part) for part in split(mesh))


def _crosses(mesh: PolygonMesh) -> bool:
    triangles = ear_clipped(mesh).triangles
    found = crossings(mesh.points, triangles)
    if len(found.pairs) or found.complete:
        return len(found.pairs) > 0
    return len(crossing_triangles(mesh.points, triangles)) > 0


def _advice(mesh: PolygonMesh, policy: RepairPolicy) -> str:
    if policy == "none" and not _fault(gently_repaired(mesh).mesh):
        return '; prepare.repair = "gentle" would cure it'
    return '; prepare.repair = "wrap" would cure it' if _has_area(mesh) else ""


def _has_area(mesh: PolygonMesh) -> bool:
    areas = area_vectors(mesh.points, ear_clipped(mesh).triangles)
    return bool((np.isfinite(areas) & (areas != 0.0)).any())
