"""What a mesh is: its polygons, components, boundaries, and everything that keeps it from being a solid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.mesh.closed import volume_shares
from fabricate.mesh.edges import (
    Edges,
    InnerEdges,
    Sheets,
    boundary_loops,
    fans,
    fans_per_point,
    point_components,
    sheets,
)
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.crossing_pairs import crossings
from fabricate.prepare.duplicates import copy_groups
from fabricate.prepare.ear_clipping import EarClipping, ear_clipped
from fabricate.prepare.places import place_numbers
from fabricate.prepare.thinnest import thinnest_place
from fabricate.triangles.normals import area_vectors

MOST_LISTED = 20
"""How many places, loops and components are told of each kind; all of them are counted."""

Place: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True)
class Found:
    """How often something occurs, and where the first times."""

    count: int
    places: tuple[Place, ...]


@dataclass(frozen=True)
class Kind:
    """How many faces have this many corners."""

    corners: int
    faces: int


@dataclass(frozen=True)
class Component:
    """Faces that hang together by common points.

    Attributes
    ----------
    faces : int
    genus : int or None
        Handles; None where it is open, non-manifold or non-orientable.
    volume_sign : int or None
        1 facing outward, -1 inside out or a cavity, 0 without volume; None unless closed and wound consistently.
    """

    faces: int
    genus: int | None
    volume_sign: int | None


@dataclass(frozen=True)
class Loop:
    """A ring of edges with one face only."""

    edges: int
    length: float
    place: Place


@dataclass(frozen=True)
class Thickness:
    """The smallest thickness, and the place it was measured from."""

    value: float
    place: Place


@dataclass(frozen=True)
class Diagnosis:
    """Everything that was found, in the unit of the mesh; plain numbers, strings and tuples throughout.

    Attributes
    ----------
    vertices, faces : int
    polygons : tuple of Kind
        By number of corners.
    size : (x, y, z)
        Of the bounding box.
    diagonal : float
    components : int
    largest_components : tuple of Component
        By falling number of faces.
    boundary_loops : int
    longest_loops : tuple of Loop
        By falling length.
    nonmanifold_edges : Found
        Edges of more than two faces.
    nonmanifold_vertices : Found
        Points where faces touch that no chain of common edges joins.
    inconsistent_edges : Found
        Edges whose two faces are wound against each other.
    non_orientable : bool
        Whether some part has one side only, so that no flipping can wind it consistently.
    degenerate_faces : Found
        Faces with a repeated corner or without area.
    duplicate_faces : Found
        Faces with the same corners in the same cycle, either way, as an earlier one.
    unreferenced_points : int
        Points without a face.
    coinciding_points : Found
        Points of faces at exactly the same place as an earlier one.
    crossings : Found
        Pairs of triangles that cross or overlap, exactly; polygons are cut into triangles first, and points
        that coincide count as one.
    crossings_complete : bool
        Whether all pairs were tried; of very tangled triangles only some are.
    thinnest : Thickness or None
        None unless every component is closed, or where no two faces are opposite.
    """

    vertices: int
    faces: int
    polygons: tuple[Kind, ...]
    size: Place
    diagonal: float
    components: int
    largest_components: tuple[Component, ...]
    boundary_loops: int
    longest_loops: tuple[Loop, ...]
    nonmanifold_edges: Found
    nonmanifold_vertices: Found
    inconsistent_edges: Found
    non_orientable: bool
    degenerate_faces: Found
    duplicate_faces: Found
    unreferenced_points: int
    coinciding_points: Found
    crossings: Found
    crossings_complete: bool
    thinnest: Thickness | None


@dataclass(frozen=True, eq=False)
class _Body:
    """A mesh and what several questions need of it."""

    mesh: PolygonMesh
    edges: Edges
    inner: InnerEdges
    covers: Sheets
    fan: Indices
    component: Indices
    """(f,) int: of each face."""
    cut: EarClipping

    @classmethod
    def of(cls, mesh: PolygonMesh) -> _Body:
        edges = Edges.of(mesh)
        inner = InnerEdges.of(mesh, edges)
        labels = point_components(mesh, edges)[mesh.corners[mesh.offsets[:-1]]]
        component = np.unique(labels, return_inverse=True)[1]
        return cls(mesh, edges, inner, sheets(mesh, inner), fans(mesh, edges), component, ear_clipped(mesh))


def diagnosed(mesh: PolygonMesh) -> Diagnosis:
    """Find out what a mesh with finite points and at least one face is, whatever its faults."""
    body = _Body.of(mesh)
    used = np.zeros(len(mesh.points), dtype=bool)
    used[mesh.corners] = True
    spread = np.ptp(mesh.points[used], axis=0)
    kinds = zip(*np.unique(mesh.face_sizes, return_counts=True), strict=True)
    listed, total = _components(body)
    loops, loop_count = _loops(body)
    crossing, complete = _crossings(body)
    wrong = body.inner.sides[~body.inner.agree, 0]
    return Diagnosis(
        vertices=len(mesh.points),
        faces=len(mesh.face_sizes),
        polygons=tuple(Kind(int(corners), int(faces)) for corners, faces in kinds),
        size=_place(spread),
        diagonal=float(np.linalg.norm(spread)),
        components=total,
        largest_components=listed,
        boundary_loops=loop_count,
        longest_loops=loops,
        nonmanifold_edges=_found(_edge_middles(mesh, body.edges.first_corner[body.edges.faces > 2])),
        nonmanifold_vertices=_found(mesh.points[fans_per_point(mesh, body.fan) > 1]),
        inconsistent_edges=_found(_edge_middles(mesh, wrong)),
        non_orientable=bool(body.covers.one_sided.any()),
        degenerate_faces=_found(_centres(mesh)[_degenerate(body)]),
        duplicate_faces=_found(_centres(mesh)[_copies(copy_groups(mesh))]),
        unreferenced_points=int((~used).sum()),
        coinciding_points=_found(mesh.points[used][_copies(place_numbers(mesh.points[used]))]),
        crossings=crossing,
        crossings_complete=complete,
        thinnest=_thinnest(body),
    )


def _components(body: _Body) -> tuple[tuple[Component, ...], int]:
    """Return the largest components, and the number of all."""
    mesh, label = body.mesh, body.component
    faces = np.bincount(label)
    closed, sound = _closed(body), _sound(body)
    euler = faces - np.bincount(label[mesh.face_of_corner], minlength=len(faces)) // 2 + _points_of(body)
    volume = np.bincount(label, volume_shares(mesh))
    listed = np.argsort(-faces, kind="stable")[:MOST_LISTED].tolist()
    return tuple(
        Component(
            int(faces[number]),
            int(2 - euler[number]) // 2 if sound[number] else None,
            int(np.sign(volume[number])) if closed[number] else None,
        )
        for number in listed
    ), len(faces)


def _points_of(body: _Body) -> Indices:
    """Return the number of points of each component."""
    points = np.full(len(body.mesh.points), -1)
    points[body.mesh.corners] = body.component[body.mesh.face_of_corner]
    return np.bincount(points[points >= 0])


def _closed(body: _Body) -> Mask:
    """Return which components are closed and wound consistently, (c,) bool."""
    faulty = body.mesh.face_of_corner[body.edges.faces[body.edges.of_corner] != 2]
    wrong = body.mesh.face_of_corner[body.inner.sides[~body.inner.agree, 0]]
    return _free_of(body, np.concatenate([faulty, wrong]))


def _sound(body: _Body) -> Mask:
    """Return which components are closed, orientable 2-manifolds, (c,) bool."""
    mesh = body.mesh
    faulty = body.edges.faces[body.edges.of_corner] != 2
    faulty |= fans_per_point(mesh, body.fan)[mesh.corners] > 1
    repeats = _with_repeats(mesh)
    return _free_of(body, np.concatenate([mesh.face_of_corner[faulty], np.flatnonzero(body.covers.one_sided), repeats]))


def _free_of(body: _Body, faces: Indices) -> Mask:
    free = np.ones(int(body.component.max()) + 1, dtype=bool)
    free[body.component[faces]] = False
    return free


def _with_repeats(mesh: PolygonMesh) -> Indices:
    """Return the faces that use a point more than once, with possible repetitions."""
    keys = np.sort(mesh.face_of_corner * len(mesh.points) + mesh.corners)
    faces: Indices = keys[1:][keys[1:] == keys[:-1]] // len(mesh.points)
    return faces


def _loops(body: _Body) -> tuple[tuple[Loop, ...], int]:
    """Return the longest boundary loops, and the number of all."""
    mesh = body.mesh
    rim, loop = boundary_loops(mesh, body.edges, body.fan)
    if not len(rim):
        return (), 0
    ends = mesh.points[np.column_stack([mesh.corners[rim], mesh.corners[mesh.next_corner[rim]]])]
    lengths = np.bincount(loop, np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))
    edges, firsts = np.bincount(loop), np.unique(loop, return_index=True)[1]
    listed = np.argsort(-lengths, kind="stable")[:MOST_LISTED].tolist()
    return tuple(
        Loop(int(edges[number]), float(lengths[number]), _place(ends[firsts[number]].mean(axis=0))) for number in listed
    ), len(lengths)


def _degenerate(body: _Body) -> Mask:
    """Return the faces with a repeated corner or without area, (f,) bool."""
    mesh = body.mesh
    areas = np.linalg.norm(area_vectors(mesh.points, body.cut.triangles), axis=1)
    degenerate: Mask = np.bincount(body.cut.face, areas, minlength=len(mesh.face_sizes)) == 0.0
    degenerate[_with_repeats(mesh)] = True
    return degenerate


def _crossings(body: _Body) -> tuple[Found, bool]:
    """Return the pairs of triangles that cross, one place of each, and whether these are all."""
    mesh = body.mesh
    places = place_numbers(mesh.points)
    points = mesh.points[np.unique(places, return_index=True)[1]]
    triangles = places[body.cut.triangles]
    triangles = triangles[(triangles != np.roll(triangles, 1, axis=1)).all(axis=1)]
    found = crossings(points, triangles)
    return _found(points[triangles[found.pairs[:, 0]]].mean(axis=1)), found.complete


def _thinnest(body: _Body) -> Thickness | None:
    if not _closed(body).all():
        return None
    inside_out = np.bincount(body.component, volume_shares(body.mesh)) < 0
    turned = inside_out[body.component[body.cut.face]] & (len(inside_out) == 1)
    triangles = np.where(turned[:, None], body.cut.triangles[:, ::-1], body.cut.triangles)
    found = thinnest_place(body.mesh.points, triangles)
    return None if found is None else Thickness(found.thickness, _place(found.place))


def _copies(groups: Indices) -> Mask:
    """Return what has the same number as something earlier, (n,) bool."""
    copies = np.ones(len(groups), dtype=bool)
    copies[np.unique(groups, return_index=True)[1]] = False
    return copies


def _edge_middles(mesh: PolygonMesh, half_edges: Indices) -> Floats:
    ends = np.column_stack([mesh.corners[half_edges], mesh.corners[mesh.next_corner[half_edges]]])
    middles: Floats = mesh.points[ends].mean(axis=1)
    return middles


def _centres(mesh: PolygonMesh) -> Floats:
    """Return the mean of each face's corners, (f, 3)."""
    sums: Floats = np.add.reduceat(mesh.points[mesh.corners], mesh.offsets[:-1])
    return sums / mesh.face_sizes[:, None]


def _found(places: Floats) -> Found:
    return Found(len(places), tuple(_place(place) for place in places[:MOST_LISTED]))


def _place(point: Floats) -> Place:
    x, y, z = point.tolist()
    return x, y, z
