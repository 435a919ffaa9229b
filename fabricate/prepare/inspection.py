"""What a mesh is, and what a run would make of it, without making it."""

from __future__ import annotations

from dataclasses import dataclass

from fabricate.config import FileConfig, PatternConfig
from fabricate.errors import MeshError
from fabricate.mesh.closed import genus
from fabricate.mesh.naming import counted
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.components import anatomy
from fabricate.prepare.density import too_fine
from fabricate.prepare.diagnosis import Diagnosis, diagnosed
from fabricate.prepare.repair import repaired


@dataclass(frozen=True)
class Inspection:
    """A diagnosis, and in one sentence each what `run` with default settings would do.

    Attributes
    ----------
    diagnosis : Diagnosis
    usable : bool
        Whether a run with default settings gets as far as dividing the surface.
    plan : tuple of str
    """

    diagnosis: Diagnosis
    usable: bool
    plan: tuple[str, ...]


SIZE, TILE_SIZE = FileConfig.model_fields["size"].default, PatternConfig.model_fields["tile_size"].default
"""What `run` takes for the size of the body and of its tiles unless it is told otherwise, mm."""


def inspected(mesh: PolygonMesh) -> Inspection:
    """Return what a mesh is and what `run` would do about it."""
    diagnosis = diagnosed(mesh)
    try:
        mended = repaired(mesh, policy="gentle")
    except MeshError as error:
        return Inspection(diagnosis, False, (f"run would refuse it: {error}",))
    repairs = ", ".join(f"{action.count} {action.name}" for action in mended.actions)
    plan = [f"run would repair it: {repairs}" if repairs else "run would take it as it is"]
    found = anatomy(mended.mesh)
    usable = len(found.bodies) + len(found.cavities) == 1
    if usable:
        plan.append(f"run would divide one closed surface of genus {genus(found.bodies[0])}")
        plan.append(_cells(found.bodies[0]))
    else:
        hollows = f" and leave {counted(len(found.cavities), 'cavity', 'cavities')} out" if found.cavities else ""
        bodies = counted(len(found.bodies), "body", "bodies")
        plan.append(
            f'run needs prepare.components = "largest" to make the largest of {bodies}{hollows}, '
            'or "each" to make all of them'
        )
    if diagnosis.crossings.count:
        plan.append('run would refuse it if its smooth surface crosses itself, too; prepare.repair = "wrap" cures that')
    return Inspection(diagnosis, usable, tuple(plan))


def _cells(body: PolygonMesh) -> str:
    asked = f"for tiles of {TILE_SIZE:g} mm on a body of {SIZE:g} mm"
    if too_fine(body, size=SIZE, tile_size=TILE_SIZE):
        return f"run would make new quads {asked}: its {len(body.offsets) - 1} triangles are too fine"
    return (
        f"run would divide its own {len(body.offsets) - 1} faces {asked}, or make new quads if a gap has no room there"
    )
