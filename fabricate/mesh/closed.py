"""The proof that a polygon mesh is one closed, orientable 2-manifold with volume."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fabricate.arrays import Floats, Indices, Mask
from fabricate.errors import MeshError
from fabricate.mesh.polygon_mesh import PolygonMesh

SMALLEST_VOLUME = 1e-12
"""A volume below this share of the cube of the bounding box's diagonal is none: rounding makes as much."""

LARGEST_COORDINATE = 1e30
"""Beyond any sculpture, and safely within the float32 numbers of an STL file, which end at 3.4e38."""


def checked_closed(mesh: PolygonMesh) -> PolygonMesh:
    """Return the mesh, faces outward, if it is one closed, orientable 2-manifold with volume.

    A mesh that is inside out as a whole (negative volume) is returned with every face reversed; any other
    comes back as it is. Faults are looked for from the most basic on, and the first kind found is raised.

    Raises
    ------
    MeshError
        If there are no faces, numbers are unusable, a face repeats a point, faces have the same corners,
        an edge has more than two faces, the surface is non-orientable, has an open boundary, is wound
        inconsistently, touches itself in a point, has several components or no volume. The message says
        how many faults there are and where one of them is.
    """
    _check_numbers(mesh)
    _check_corners_differ(mesh)
    _check_faces_differ(mesh)
    edges = _edges(mesh)
    _check_two_faces_at_most(mesh, edges)
    inner = _inner_edges(mesh, edges)
    _check_orientable(mesh, inner)
    _check_no_boundary(mesh, edges)
    _check_winding(mesh, inner)
    _check_one_fan_per_point(mesh, inner)
    _check_one_component(mesh, edges)
    return _outward(mesh)


def genus(mesh: PolygonMesh) -> int:
    """Return the number of handles of one closed, orientable surface, from V - E + F = 2 - 2g.

    Parameters
    ----------
    mesh : PolygonMesh
        As returned by `checked_closed`; of anything else the number means nothing.
    """
    vertices, edges, faces = len(np.unique(mesh.corners)), len(mesh.corners) // 2, len(mesh.offsets) - 1
    return (2 - vertices + edges - faces) // 2


def signed_volume(mesh: PolygonMesh) -> float:
    """Return the volume enclosed by a closed mesh, in cubed units of its points; negative if inside out.

    Each polygon is taken as the fan of triangles round the mean of its corners, so that polygons that are
    not flat have one well-defined surface, whichever corner they begin with.
    """
    points = mesh.points - (mesh.points.min(axis=0) + mesh.points.max(axis=0)) / 2  # less cancellation
    begins = points[mesh.corners]
    ends = begins[mesh.next_corner]
    centres = np.add.reduceat(begins, mesh.offsets[:-1]) / mesh.face_sizes[:, None]
    return float(np.einsum("ij,ij->", centres[mesh.face_of_corner], np.cross(begins, ends)) / 6)


@dataclass(frozen=True, eq=False)
class _Edges:
    """Undirected edges.

    Attributes
    ----------
    ends : (e, 2) int
        The two points, the lower index first.
    of_corner : (h,) int
        The edge that each half-edge lies on.
    faces : (e,) int
        Number of half-edges on each edge.
    """

    ends: Indices
    of_corner: Indices
    faces: Indices


@dataclass(frozen=True, eq=False)
class _InnerEdges:
    """The edges where exactly two faces meet.

    Attributes
    ----------
    sides : (i, 2) int
        The two half-edges on each edge.
    agree : (i,) bool
        Whether they run in opposite directions, as those of consistently wound faces do.
    """

    sides: Indices
    agree: Mask


def _edges(mesh: PolygonMesh) -> _Edges:
    begins, ends = mesh.corners, mesh.corners[mesh.next_corner]
    keys = np.minimum(begins, ends) * len(mesh.points) + np.maximum(begins, ends)
    unique, of_corner, faces = np.unique(keys, return_inverse=True, return_counts=True)
    return _Edges(np.column_stack(np.divmod(unique, len(mesh.points))), of_corner, faces)


def _inner_edges(mesh: PolygonMesh, edges: _Edges) -> _InnerEdges:
    by_edge = np.argsort(edges.of_corner, kind="stable")
    firsts = (np.cumsum(edges.faces) - edges.faces)[edges.faces == 2]
    sides = np.column_stack([by_edge[firsts], by_edge[firsts + 1]])
    begins = mesh.corners[sides]
    return _InnerEdges(sides, begins[:, 0] != begins[:, 1])


def _check_numbers(mesh: PolygonMesh) -> None:
    if len(mesh.offsets) < 2:
        raise MeshError(f"a closed surface was expected, but the mesh has no faces, only {len(mesh.points)} points")
    if (mesh.face_sizes < 3).any():
        raise MeshError(f"{_count((mesh.face_sizes < 3).sum(), 'face')} with fewer than 3 corners; remove them")
    if mesh.corners.min() < 0 or mesh.corners.max() >= len(mesh.points):
        raise MeshError(
            f"faces refer to points {mesh.corners.min()} to {mesh.corners.max()}, "
            f"but the points are numbered 0 to {len(mesh.points) - 1}"
        )
    unused = len(mesh.points) - len(np.unique(mesh.corners))
    if unused:
        raise MeshError(f"{_count(unused, 'point')} without any face; remove them")
    usable = (np.abs(mesh.points) <= LARGEST_COORDINATE).all(axis=1)
    if not usable.all():
        raise MeshError(
            f"point {np.argmin(usable)} is at {_place(mesh.points[np.argmin(usable)])}; "
            f"coordinates have to be finite and at most {LARGEST_COORDINATE:g}"
        )


def _check_corners_differ(mesh: PolygonMesh) -> None:
    keys = np.sort(mesh.face_of_corner * len(mesh.points) + mesh.corners)
    faces, corners = np.divmod(keys[1:][keys[1:] == keys[:-1]], len(mesh.points))
    if len(faces):
        raise MeshError(
            f"{_count(len(np.unique(faces)), 'face')} with a point used more than once, "
            f"for example at {_place(mesh.points[corners[0]])}; "
            "split these faces or drop their repeated corners"
        )


def _check_faces_differ(mesh: PolygonMesh) -> None:
    copies = np.concatenate([_copied_faces(mesh, size) for size in np.unique(mesh.face_sizes)])
    if len(copies):
        raise MeshError(
            f"{_count(len(copies), 'face')} with exactly the same corners as another face, "
            f"for example at {_place(_face_centre(mesh, copies[0]))}; remove the copies (a sheet without "
            "thickness has no inside)"
        )


def _copied_faces(mesh: PolygonMesh, size: int) -> Indices:
    """Return the faces of `size` corners whose set of corners an earlier face has too."""
    faces = np.flatnonzero(mesh.face_sizes == size)
    corners = np.sort(mesh.corners[mesh.offsets[faces][:, None] + np.arange(size)], axis=1)
    order = np.lexsort(corners.T)
    same = (corners[order[1:]] == corners[order[:-1]]).all(axis=1)
    return np.sort(faces[order[1:][same]])


def _check_two_faces_at_most(mesh: PolygonMesh, edges: _Edges) -> None:
    crowded = np.flatnonzero(edges.faces > 2)
    if len(crowded):
        raise MeshError(
            f"{_count(len(crowded), 'non-manifold edge')} where more than two faces meet, for example "
            f"{edges.faces[crowded[0]]} faces at {_place(_middle(mesh, edges.ends[crowded[0]]))}; "
            "remove inner walls and copies of faces, or pull touching bodies apart"
        )


def _check_orientable(mesh: PolygonMesh, inner: _InnerEdges) -> None:
    if inner.agree.all():
        return
    upper, lower = _sheets(mesh, inner)
    one_sided = upper == lower
    if one_sided.any():
        twisted = one_sided[mesh.face_of_corner[inner.sides[:, 0]]] & ~inner.agree
        raise MeshError(
            "the surface is non-orientable, like a Moebius strip: it has only one side, and no flipping of "
            f"faces can give it an inside; {_count(twisted.sum(), 'edge')} wound inconsistently, for example "
            f"at {_place(_side_middle(mesh, inner.sides[twisted][0]))}"
        )


def _check_no_boundary(mesh: PolygonMesh, edges: _Edges) -> None:
    open_edges = np.flatnonzero(edges.faces == 1)
    if not len(open_edges):
        return
    ends = edges.ends[open_edges]
    labels = _components(len(mesh.points), ends)
    loops = len(np.unique(labels[ends]))
    raise MeshError(
        f"the surface has an open boundary of {_count(len(open_edges), 'edge')} in {_count(loops, 'loop')}, "
        f"for example at {_place(_middle(mesh, ends[0]))}; {_boundary_advice(mesh, ends)}"
    )


def _boundary_advice(mesh: PolygonMesh, ends: Indices) -> str:
    rim = mesh.points[np.unique(ends)]
    coinciding = len(rim) - len(np.unique(rim, axis=0))
    if coinciding:
        return f"{_count(coinciding, 'boundary point')} on the very spot of another: merge such points first"
    return "close the holes first"


def _check_winding(mesh: PolygonMesh, inner: _InnerEdges) -> None:
    if inner.agree.all():
        return
    upper, lower = _sheets(mesh, inner)
    first_sheets = np.minimum(upper, lower)
    sizes = np.bincount(first_sheets)
    on_first = np.bincount(first_sheets[upper < lower], minlength=len(sizes))
    flips = int(np.minimum(on_first, sizes - on_first).sum())
    wrong = inner.sides[~inner.agree]
    raise MeshError(
        f"faces are wound inconsistently along {_count(len(wrong), 'edge')}, for example at "
        f"{_place(_side_middle(mesh, wrong[0]))}; the surface is orientable, "
        f"flipping {_count(flips, 'face')} would cure it"
    )


def _sheets(mesh: PolygonMesh, inner: _InnerEdges) -> tuple[Indices, Indices]:
    """Return the component of the orientation double cover that each face, as it is and flipped, lies in.

    A face's two copies lie in different components exactly when its part of the surface is orientable.
    """
    faces = len(mesh.offsets) - 1
    left, right = mesh.face_of_corner[inner.sides].T
    turned = np.where(inner.agree, 0, faces)
    links = np.concatenate(
        [np.column_stack([left, right + turned]), np.column_stack([left + faces, right + faces - turned])]
    )
    labels = _components(2 * faces, links)
    return labels[:faces], labels[faces:]


def _check_one_fan_per_point(mesh: PolygonMesh, inner: _InnerEdges) -> None:
    side, twin = inner.sides.T
    following = mesh.next_corner
    links = np.concatenate([np.column_stack([side, following[twin]]), np.column_stack([following[side], twin])])
    _, firsts = np.unique(_components(len(mesh.corners), links), return_index=True)
    fans = np.bincount(mesh.corners[firsts], minlength=len(mesh.points))
    pinched = np.flatnonzero(fans > 1)
    if len(pinched):
        raise MeshError(
            f"{_count(len(pinched), 'non-manifold vertex', 'non-manifold vertices')} where the surface "
            f"touches itself, for example {fans[pinched[0]]} fans of faces at "
            f"{_place(mesh.points[pinched[0]])}; give each fan its own point"
        )


def _check_one_component(mesh: PolygonMesh, edges: _Edges) -> None:
    labels = _components(len(mesh.points), edges.ends)
    if labels.max() > 0:
        other = mesh.points[np.argmax(labels != labels[0])]
        raise MeshError(
            f"one connected surface was expected, but there are {labels.max() + 1} components, for example "
            f"at {_place(mesh.points[0])} and {_place(other)}; keep one of them in the file or unite them"
        )


def _outward(mesh: PolygonMesh) -> PolygonMesh:
    volume = signed_volume(mesh)
    diagonal = float(np.linalg.norm(np.ptp(mesh.points, axis=0)))
    if abs(volume) <= SMALLEST_VOLUME * diagonal**3:
        raise MeshError(
            f"the surface encloses no volume: {volume:.3g} cubic units, with a diagonal of {diagonal:.6g} "
            f"round {_place(mesh.points.mean(axis=0))}; a sheet has to be given thickness first"
        )
    return mesh if volume > 0 else _reversed(mesh)


def _reversed(mesh: PolygonMesh) -> PolygonMesh:
    """Return the mesh with every face wound the other way, beginning with the same corner."""
    begins = mesh.offsets[mesh.face_of_corner]
    places = np.arange(len(mesh.corners)) - begins
    return PolygonMesh(mesh.points, mesh.corners[begins + -places % mesh.face_sizes[mesh.face_of_corner]], mesh.offsets)


def _components(nodes: int, links: Indices) -> Indices:
    """Return the number of the component that each node lies in."""
    graph = coo_array((np.ones(len(links)), (links[:, 0], links[:, 1])), shape=(nodes, nodes))
    return connected_components(graph, directed=False)[1].astype(np.int64)


def _middle(mesh: PolygonMesh, corners: Indices) -> Floats:
    middle: Floats = mesh.points[corners].mean(axis=0)
    return middle


def _side_middle(mesh: PolygonMesh, side: Indices) -> Floats:
    return _middle(mesh, mesh.corners[[side[0], mesh.next_corner[side[0]]]])


def _face_centre(mesh: PolygonMesh, face: int) -> Floats:
    return _middle(mesh, mesh.corners[mesh.offsets[face] : mesh.offsets[face + 1]])


def _place(point: Floats) -> str:
    return "(" + ", ".join(f"{value:.6g}" for value in point) + ")"


def _count(number: int, noun: str, plural: str = "") -> str:
    return f"{number} {noun if number == 1 else plural or noun + 's'}"
