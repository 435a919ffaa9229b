"""The proof that a polygon mesh is one closed, orientable 2-manifold with volume."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.errors import MeshError
from fabricate.mesh.edges import Edges, InnerEdges, boundary_loops, fans, fans_per_point, point_components, sheets
from fabricate.mesh.naming import counted, place
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.winding import fewest_flips, flipped

SMALLEST_VOLUME = 1e-12
"""A volume below this share of the cube of the bounding box's diagonal is none: rounding makes as much."""

LARGEST_COORDINATE = 1e45
"""Beyond what float32 holds, and so small that squares of areas and cubes of lengths are finite."""


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
    check_closed_manifold(mesh)
    _check_one_component(mesh)
    return outward(mesh)


def check_closed_manifold(mesh: PolygonMesh) -> None:
    """Check that every component of the mesh is a closed, consistently wound 2-manifold.

    Raises
    ------
    MeshError
        For the faults of `checked_closed`, but for several components, and components without volume.
    """
    _check_numbers(mesh)
    _check_corners_differ(mesh)
    _check_faces_differ(mesh)
    edges = Edges.of(mesh)
    _check_two_faces_at_most(mesh, edges)
    inner = InnerEdges.of(mesh, edges)
    _check_orientable(mesh, inner)
    _check_no_boundary(mesh, edges)
    _check_winding(mesh, inner)
    _check_one_fan_per_point(mesh, edges)


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
    return float(volume_shares(mesh).sum())


def volume_shares(mesh: PolygonMesh) -> Floats:
    """Return what each face adds to the volume, (f,) float: that of the cone from it to one common point."""
    points = mesh.points - (mesh.points.min(axis=0) + mesh.points.max(axis=0)) / 2  # less cancellation
    begins = points[mesh.corners]
    ends = begins[mesh.next_corner]
    centres = np.add.reduceat(begins, mesh.offsets[:-1]) / mesh.face_sizes[:, None]
    cones = np.einsum("ij,ij->i", centres[mesh.face_of_corner], np.cross(begins, ends)) / 6
    shares: Floats = np.add.reduceat(cones, mesh.offsets[:-1])
    return shares


def _check_numbers(mesh: PolygonMesh) -> None:
    if len(mesh.offsets) < 2:
        raise MeshError(f"a closed surface was expected, but the mesh has no faces, only {len(mesh.points)} points")
    if (mesh.face_sizes < 3).any():
        raise MeshError(f"{counted((mesh.face_sizes < 3).sum(), 'face')} with fewer than 3 corners; remove them")
    if mesh.corners.min() < 0 or mesh.corners.max() >= len(mesh.points):
        raise MeshError(
            f"faces refer to points {mesh.corners.min()} to {mesh.corners.max()}, "
            f"but the points are numbered 0 to {len(mesh.points) - 1}"
        )
    unused = len(mesh.points) - len(np.unique(mesh.corners))
    if unused:
        raise MeshError(f"{counted(unused, 'point')} without any face; remove them")
    usable = (np.abs(mesh.points) <= LARGEST_COORDINATE).all(axis=1)
    if not usable.all():
        raise MeshError(
            f"point {np.argmin(usable)} is at {place(mesh.points[np.argmin(usable)])}; "
            f"coordinates have to be finite and at most {LARGEST_COORDINATE:g}"
        )


def _check_corners_differ(mesh: PolygonMesh) -> None:
    keys = np.sort(mesh.face_of_corner * len(mesh.points) + mesh.corners)
    faces, corners = np.divmod(keys[1:][keys[1:] == keys[:-1]], len(mesh.points))
    if len(faces):
        raise MeshError(
            f"{counted(len(np.unique(faces)), 'face')} with a point used more than once, "
            f"for example at {place(mesh.points[corners[0]])}; "
            "split these faces or drop their repeated corners"
        )


def _check_faces_differ(mesh: PolygonMesh) -> None:
    copies = np.concatenate([_copied_faces(mesh, size) for size in np.unique(mesh.face_sizes)])
    if len(copies):
        raise MeshError(
            f"{counted(len(copies), 'face')} with exactly the same corners as another face, "
            f"for example at {place(_face_centre(mesh, copies[0]))}; remove the copies (a sheet without "
            "thickness has no inside)"
        )


def _copied_faces(mesh: PolygonMesh, size: int) -> Indices:
    """Return the faces of `size` corners whose set of corners an earlier face has too."""
    faces = np.flatnonzero(mesh.face_sizes == size)
    corners = np.sort(mesh.corners[mesh.offsets[faces][:, None] + np.arange(size)], axis=1)
    order = np.lexsort(corners.T)
    same = (corners[order[1:]] == corners[order[:-1]]).all(axis=1)
    return np.sort(faces[order[1:][same]])


def _check_two_faces_at_most(mesh: PolygonMesh, edges: Edges) -> None:
    crowded = np.flatnonzero(edges.faces > 2)
    if len(crowded):
        raise MeshError(
            f"{counted(len(crowded), 'non-manifold edge')} where more than two faces meet, for example "
            f"{edges.faces[crowded[0]]} faces at {place(_middle(mesh, edges.ends[crowded[0]]))}; "
            "remove inner walls and copies of faces, or pull touching bodies apart"
        )


def _check_orientable(mesh: PolygonMesh, inner: InnerEdges) -> None:
    if inner.agree.all():
        return
    one_sided = sheets(mesh, inner).one_sided
    if one_sided.any():
        twisted = one_sided[mesh.face_of_corner[inner.sides[:, 0]]] & ~inner.agree
        raise MeshError(
            "the surface is non-orientable, like a Moebius strip: it has only one side, and no flipping of "
            f"faces can give it an inside; {counted(twisted.sum(), 'edge')} wound inconsistently, for example "
            f"at {place(_side_middle(mesh, inner.sides[twisted][0]))}"
        )


def _check_no_boundary(mesh: PolygonMesh, edges: Edges) -> None:
    open_edges = np.flatnonzero(edges.faces == 1)
    if not len(open_edges):
        return
    ends = edges.ends[open_edges]
    loops = boundary_loops(mesh, edges, fans(mesh, edges))[1].max() + 1
    raise MeshError(
        f"the surface has an open boundary of {counted(len(open_edges), 'edge')} in {counted(loops, 'loop')}, "
        f"for example at {place(_middle(mesh, ends[0]))}; {_boundary_advice(mesh, ends)}"
    )


def _boundary_advice(mesh: PolygonMesh, ends: Indices) -> str:
    rim = mesh.points[np.unique(ends)]
    coinciding = len(rim) - len(np.unique(rim, axis=0))
    if coinciding:
        return f"{counted(coinciding, 'boundary point')} on the very spot of another: merge such points first"
    return "close the holes first"


def _check_winding(mesh: PolygonMesh, inner: InnerEdges) -> None:
    if inner.agree.all():
        return
    flips = fewest_flips(sheets(mesh, inner)).sum()
    wrong = inner.sides[~inner.agree]
    raise MeshError(
        f"faces are wound inconsistently along {counted(len(wrong), 'edge')}, for example at "
        f"{place(_side_middle(mesh, wrong[0]))}; the surface is orientable, "
        f"flipping {counted(flips, 'face')} would cure it"
    )


def _check_one_fan_per_point(mesh: PolygonMesh, edges: Edges) -> None:
    found = fans_per_point(mesh, fans(mesh, edges))
    pinched = np.flatnonzero(found > 1)
    if len(pinched):
        raise MeshError(
            f"{counted(len(pinched), 'non-manifold vertex', 'non-manifold vertices')} where the surface "
            f"touches itself, for example {found[pinched[0]]} fans of faces at "
            f"{place(mesh.points[pinched[0]])}; give each fan its own point"
        )


def _check_one_component(mesh: PolygonMesh) -> None:
    labels = point_components(mesh, Edges.of(mesh))
    if labels.max() > 0:
        other = mesh.points[np.argmax(labels != labels[0])]
        raise MeshError(
            f"one connected surface was expected, but there are {labels.max() + 1} components, for example "
            f"at {place(mesh.points[0])} and {place(other)}; keep one of them in the file or unite them"
        )


def outward(mesh: PolygonMesh) -> PolygonMesh:
    """Return a closed component with positive volume: as it is, or with every face flipped.

    Raises
    ------
    MeshError
        If it encloses no volume.
    """
    volume = signed_volume(mesh)
    diagonal = float(np.linalg.norm(np.ptp(mesh.points, axis=0)))
    if abs(volume) <= SMALLEST_VOLUME * diagonal**3:
        raise MeshError(
            f"the surface encloses no volume: {volume:.3g} cubic units, with a diagonal of {diagonal:.6g} "
            f"round {place(mesh.points.mean(axis=0))}; a sheet has to be given thickness first"
        )
    return mesh if volume > 0 else flipped(mesh, np.ones(len(mesh.offsets) - 1, dtype=bool))


def _middle(mesh: PolygonMesh, corners: Indices) -> Floats:
    middle: Floats = mesh.points[corners].mean(axis=0)
    return middle


def _side_middle(mesh: PolygonMesh, side: Indices) -> Floats:
    return _middle(mesh, mesh.corners[[side[0], mesh.next_corner[side[0]]]])


def _face_centre(mesh: PolygonMesh, face: int) -> Floats:
    return _middle(mesh, mesh.corners[mesh.offsets[face] : mesh.offsets[face + 1]])
