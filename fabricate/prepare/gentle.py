"""Gentle repair: connections and winding are mended, and no point is moved."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Indices, Mask
from fabricate.errors import MeshError
from fabricate.mesh.closed import check_closed_manifold
from fabricate.mesh.edges import Edges, connected, fans
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.duplicates import superfluous
from fabricate.prepare.orientation import oriented
from fabricate.prepare.places import place_numbers
from fabricate.prepare.repaired import Action, Repaired

UNDOING = ("points welded", "touching points split")  # on a rim, fans that merely touch are welded, then split again


def gently_repaired(mesh: PolygonMesh) -> Repaired:
    """Weld, drop, split and flip whatever keeps a mesh from being closed components that face outward.

    Points at exactly the same place are welded where the surface is open and where an edge has no length,
    the latter only if no handle is lost by that; bodies that merely touch stay apart. Corners repeated in a
    row, faces of fewer than three corners, copies of faces and points without a face are dropped. Points where
    fans of faces merely touch become one point per fan. Faces are flipped as `oriented` says. What cannot be
    mended so is left as it is, also triangles without area whose corners differ: without them the surface
    would be open.

    Parameters
    ----------
    mesh : PolygonMesh
        Any; corners within the points.

    Returns
    -------
    Repaired
        The very same mesh, with its numbering, if nothing had to be done.
    """
    if is_closed_manifold(mesh) and not _lengthless(mesh, Edges.of(mesh)).any() and not oriented(mesh).flips.any():
        return Repaired(mesh, ())
    careful = _repaired(mesh, shrinking=False)
    if not _lengthless(careful.mesh, Edges.of(careful.mesh)).any():
        return careful
    thorough = _repaired(mesh, shrinking=True)
    return thorough if _as_good(thorough.mesh, careful.mesh) else careful


def is_closed_manifold(mesh: PolygonMesh) -> bool:
    """Return whether every component is a closed, consistently wound 2-manifold."""
    try:
        check_closed_manifold(mesh)
    except MeshError:
        return False
    return True


def _as_good(mesh: PolygonMesh, other: PolygonMesh) -> bool:
    """Return whether a mesh is closed with as many handles as the other, if that is closed."""
    return not is_closed_manifold(other) or (is_closed_manifold(mesh) and _euler(mesh) == _euler(other))


def _euler(mesh: PolygonMesh) -> int:
    return len(mesh.points) - len(mesh.corners) // 2 + len(mesh.offsets) - 1


def _repaired(mesh: PolygonMesh, *, shrinking: bool) -> Repaired:
    """Take all steps once; with `shrinking`, edges of no length become points."""
    used = len(np.unique(mesh.corners))
    tidy, actions = _without_repeats(mesh)
    welding = _merged_points(tidy, shrinking=shrinking)
    tidy, further = _without_repeats(PolygonMesh(tidy.points, welding[tidy.corners], tidy.offsets))
    surplus = superfluous(tidy)
    tidy = _with_faces(tidy, ~surplus)
    tidy, splits = _split_fans(tidy)
    tidy, flips = oriented(tidy)
    counts = {
        "points without a face dropped": len(mesh.points) - used,
        "repeated corners dropped": actions[0] + further[0],
        "degenerate faces dropped": actions[1] + further[1],
        "points welded": int((welding != np.arange(len(welding))).sum()),
        "duplicate faces dropped": int(surplus.sum()),
        "touching points split": splits,
        "faces flipped": int(flips.sum()),
    }
    done = tuple(Action(name, count) for name, count in counts.items() if count)
    if all(action.name in UNDOING for action in done) and _only_renumbered(mesh.corners, tidy.corners):
        return Repaired(mesh, ())
    return Repaired(_compact(tidy), done)


def _only_renumbered(corners: Indices, others: Indices) -> bool:
    """Return whether two lists of corners, both (c,) int, differ by the numbers of the points only."""
    pairs = np.unique(np.column_stack([corners, others]), axis=0)
    return len(pairs) == len(np.unique(corners)) == len(np.unique(others))


def _without_repeats(mesh: PolygonMesh) -> tuple[PolygonMesh, tuple[int, int]]:
    """Drop corners that the next one repeats, then faces of fewer than 3 corners; say how many of each.

    Corners of faces that vanish are not counted.
    """
    keep = mesh.corners != mesh.corners[mesh.next_corner]
    sizes = np.bincount(mesh.face_of_corner[keep], minlength=len(mesh.offsets) - 1)
    shorter = PolygonMesh(mesh.points, mesh.corners[keep], np.concatenate([[0], np.cumsum(sizes)]))
    enough = sizes >= 3
    repeats = int((~keep & enough[mesh.face_of_corner]).sum())
    return _with_faces(shorter, enough), (repeats, int((~enough).sum()))


def _with_faces(mesh: PolygonMesh, faces: Mask) -> PolygonMesh:
    if faces.all():
        return mesh
    sizes = mesh.face_sizes[faces]
    return PolygonMesh(mesh.points, mesh.corners[faces[mesh.face_of_corner]], np.concatenate([[0], np.cumsum(sizes)]))


def _merged_points(mesh: PolygonMesh, *, shrinking: bool) -> Indices:
    """Return the point that stands for each point, (n,) int: the first of those that are welded into one."""
    edges = Edges.of(mesh)
    rim = np.unique(edges.ends[edges.faces == 1])
    links = [_chained(rim, place_numbers(mesh.points[rim]))]
    if shrinking:
        links.append(edges.ends[_lengthless(mesh, edges)])
    label = connected(len(mesh.points), np.concatenate(links))
    firsts: Indices = np.unique(label, return_index=True)[1]
    return firsts[label]


def _lengthless(mesh: PolygonMesh, edges: Edges) -> Mask:
    same: Mask = (mesh.points[edges.ends[:, 0]] == mesh.points[edges.ends[:, 1]]).all(axis=1)
    return same


def _chained(numbers: Indices, groups: Indices) -> Indices:
    """Return pairs, (k, 2), that link all numbers of each group."""
    order = np.argsort(groups, kind="stable")
    same = groups[order[1:]] == groups[order[:-1]]
    return np.column_stack([numbers[order[:-1]][same], numbers[order[1:]][same]])


def _split_fans(mesh: PolygonMesh) -> tuple[PolygonMesh, int]:
    """Give each fan of faces its own point; the first fan at a point keeps it, copies come last."""
    fan = fans(mesh, Edges.of(mesh))
    _, firsts, fan = np.unique(fan, return_index=True, return_inverse=True)
    point = mesh.corners[firsts]
    order = np.lexsort([firsts, point])
    is_copy = np.zeros(len(point), dtype=bool)
    is_copy[order[1:]] = point[order[1:]] == point[order[:-1]]
    copies = int(is_copy.sum())
    new_point = point.copy()
    new_point[is_copy] = len(mesh.points) + np.arange(copies)
    points = np.concatenate([mesh.points, mesh.points[point[is_copy]]])
    return PolygonMesh(points, new_point[fan], mesh.offsets), copies


def _compact(mesh: PolygonMesh) -> PolygonMesh:
    """Return the mesh without points that no face uses."""
    used = np.zeros(len(mesh.points), dtype=bool)
    used[mesh.corners] = True
    return PolygonMesh(mesh.points[used], (np.cumsum(used) - 1)[mesh.corners], mesh.offsets)
