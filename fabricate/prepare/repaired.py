"""What repair hands on: the mesh, and what was done to it."""

from __future__ import annotations

from dataclasses import dataclass

from fabricate.mesh.polygon_mesh import PolygonMesh


@dataclass(frozen=True)
class Action:
    """One kind of change to a mesh, as "points welded", and how many times it was made."""

    name: str
    count: int


@dataclass(frozen=True, eq=False)
class Repaired:
    """A mesh after repair, and every change that was made, in order; none where the mesh is as it was."""

    mesh: PolygonMesh
    actions: tuple[Action, ...]
