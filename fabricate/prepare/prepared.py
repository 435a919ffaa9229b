"""The stage: from a mesh as it was read to the bodies that are divided."""

from __future__ import annotations

from dataclasses import dataclass

from fabricate.mesh.closed import checked_closed, genus
from fabricate.mesh.crease import creased, fanned_corners
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.components import ComponentPolicy, chosen
from fabricate.prepare.enclosure import WRAPPED
from fabricate.prepare.repair import RepairPolicy, repaired
from fabricate.prepare.repaired import Action
from fabricate.prepare.store import NOTHING_KEPT, Store


@dataclass(frozen=True, eq=False)
class Prepared:
    """One body, and what was done to come to it.

    Attributes
    ----------
    mesh : PolygonMesh
        One closed, orientable 2-manifold with volume, in the unit of the file.
    actions : tuple of Action
        Every repair, in order; none where the mesh is as it was read.
    notes : tuple of str
        What a user should know of the way it went.
    """

    mesh: PolygonMesh
    actions: tuple[Action, ...]
    notes: tuple[str, ...]

    @property
    def wrapped(self) -> bool:
        """Whether the body is a new skin, whose faces nobody laid out."""
        return _wrapped(self.actions)


def prepared(
    mesh: PolygonMesh,
    *,
    repair: RepairPolicy,
    components: ComponentPolicy,
    crease: float | None,
    store: Store = NOTHING_KEPT,
) -> tuple[Prepared, ...]:
    """Return the bodies of a mesh, mended by `repair`, with edges sharper than `crease`, degrees, kept sharp.

    Raises
    ------
    MeshError
        If a fault is left, or there are several bodies and `components` is "only".
    PrepareError
        If the mesh has to be wrapped, and libraries for that are missing.
    """
    mended = repaired(mesh, policy=repair, store=store)
    bodies = [checked_closed(body) for body in chosen(mended.mesh, policy=components)]
    notes = _wrapping(mended.actions, bodies)
    sharp = bodies if crease is None else [fanned_corners(creased(body, angle=crease)) for body in bodies]
    return tuple(Prepared(body, mended.actions, notes) for body in sharp)


def _wrapping(actions: tuple[Action, ...], bodies: list[PolygonMesh]) -> tuple[str, ...]:
    """Say what wrapping made of the topology: the input had none that could be kept."""
    if not _wrapped(actions):
        return ()
    handles = sum(genus(body) for body in bodies)
    return (f"the input was wrapped in a new skin, and that has genus {handles}, whatever the input had",)


def _wrapped(actions: tuple[Action, ...]) -> bool:
    return any(action.name == WRAPPED for action in actions)
