"""Connected components of a mesh: which are bodies, which are cavities in bodies, and which of them are made."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from fabricate.arrays import Indices
from fabricate.errors import MeshError
from fabricate.mesh.closed import signed_volume
from fabricate.mesh.edges import Edges, point_components
from fabricate.mesh.naming import counted, place
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.nesting import containers

ComponentPolicy: TypeAlias = Literal["only", "largest", "each"]


@dataclass(frozen=True)
class Anatomy:
    """The closed components of a mesh, each kind by falling volume.

    Attributes
    ----------
    bodies : tuple of PolygonMesh
        What can be divided into two parts.
    cavities : tuple of PolygonMesh
        Components that face inward inside a body: hollows, which bound no material of their own.
    """

    bodies: tuple[PolygonMesh, ...]
    cavities: tuple[PolygonMesh, ...]


def split(mesh: PolygonMesh) -> tuple[PolygonMesh, ...]:
    """Return the components, in the order of their first faces, each with its points and faces in their order.

    Faces with a common point are in one component. Points without a face are in none. A mesh that is one
    component comes back as it is.
    """
    label = point_components(mesh, Edges.of(mesh))
    present, of_face = np.unique(label[mesh.corners[mesh.offsets[:-1]]], return_inverse=True)
    if len(present) == 1 and label.max() == 0:
        return (mesh,)
    firsts = np.unique(of_face, return_index=True)[1]
    of_face = np.argsort(np.argsort(firsts))[of_face]
    return _split_by(mesh, of_face, len(present))


def _split_by(mesh: PolygonMesh, of_face: Indices, count: int) -> tuple[PolygonMesh, ...]:
    of_corner = of_face[mesh.face_of_corner]
    of_point = np.full(len(mesh.points), count)
    of_point[mesh.corners] = of_corner
    corners, points, sizes = mesh.corners, np.argsort(of_point, kind="stable"), mesh.face_sizes
    rank = np.zeros(len(points), dtype=np.int64)
    ends = np.cumsum(np.bincount(of_point, minlength=count + 1))
    rank[points] = np.arange(len(points)) - np.repeat(np.concatenate([[0], ends[:-1]]), np.diff(ends, prepend=0))
    cuts = [np.cumsum(np.bincount(numbers, minlength=count))[:-1] for numbers in (of_corner, of_face)]
    corner_groups = np.split(rank[corners[np.argsort(of_corner, kind="stable")]], cuts[0])
    size_groups = np.split(sizes[np.argsort(of_face, kind="stable")], cuts[1])
    point_groups = np.split(mesh.points[points], ends[:count])[:count]
    return tuple(
        PolygonMesh(own_points, own_corners, np.concatenate([[0], np.cumsum(own_sizes)]))
        for own_points, own_corners, own_sizes in zip(point_groups, corner_groups, size_groups, strict=True)
    )


def components(mesh: PolygonMesh) -> tuple[PolygonMesh, ...]:
    """Return all closed components, the one with the largest volume first; of equal ones the first in the file."""
    return tuple(sorted(split(mesh), key=lambda part: -abs(signed_volume(part))))


def anatomy(mesh: PolygonMesh) -> Anatomy:
    """Tell bodies from cavities among the closed components of a mesh.

    A cavity has negative volume and lies inside another component. A body inside another, as a ball in a
    rattle, is a body, and so is a component that is inside out, but inside no other.
    """
    parts = components(mesh)
    if len(parts) == 1:
        return Anatomy(parts, ())
    inward = [signed_volume(part) < 0 for part in parts]
    if not any(inward):
        return Anatomy(parts, ())
    hollow = [faces and len(outer) > 0 for faces, outer in zip(inward, containers(parts), strict=True)]
    return Anatomy(
        tuple(part for part, is_hollow in zip(parts, hollow, strict=True) if not is_hollow),
        tuple(part for part, is_hollow in zip(parts, hollow, strict=True) if is_hollow),
    )


def chosen(mesh: PolygonMesh, *, policy: ComponentPolicy) -> tuple[PolygonMesh, ...]:
    """Return the bodies that are made of a mesh whose components are all closed.

    "only" is for meshes of a single component. "largest" takes the body of largest volume and "each" all
    bodies, by falling volume; both leave cavities out, as a duotone surface divides an outside: a body with a
    cavity is made as if it were filled.

    Raises
    ------
    MeshError
        With "only", if there are several components, cavities counted; the message names the other policies.
    """
    found = anatomy(mesh)
    if policy == "only" and len(found.bodies) + len(found.cavities) > 1:
        raise MeshError(_several(found))
    return found.bodies[:1] if policy == "largest" else found.bodies


def _several(found: Anatomy) -> str:
    bodies, cavities = found.bodies, found.cavities
    examples = " and ".join(place(part.points.mean(axis=0)) for part in (bodies + cavities)[:2])
    hollows = f" with {counted(len(cavities), 'cavity', 'cavities')} inside" if cavities else ""
    advice = (
        f'set prepare.components = "largest" to make the largest alone, or "each" to make all {len(bodies)}'
        if len(bodies) > 1
        else 'set prepare.components = "largest", or "each", to make it as if it were filled'
    )
    left_out = "; both leave cavities out" if cavities and len(bodies) > 1 else ""
    return (
        f"one connected surface was expected, found {counted(len(bodies), 'body', 'bodies')}{hollows}, "
        f"for example round {examples}; {advice}{left_out}"
    )
