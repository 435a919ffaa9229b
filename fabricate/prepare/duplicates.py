"""Faces that lie exactly on other faces."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Indices, Mask
from fabricate.mesh.edges import Edges, connected
from fabricate.mesh.polygon_mesh import PolygonMesh


def copy_groups(mesh: PolygonMesh) -> Indices:
    """Return the number of the group of each face, (f,) int: faces with the same corners in the same cycle.

    Cycles that run the opposite ways are the same. Groups are numbered by size of face, then by corners.
    """
    groups = np.zeros(len(mesh.offsets) - 1, dtype=np.int64)
    begin = 0
    for size in np.unique(mesh.face_sizes):
        faces = np.flatnonzero(mesh.face_sizes == size)
        cycles = _canonical(mesh.corners[mesh.offsets[faces][:, None] + np.arange(size)])
        order = np.lexsort(cycles.T[::-1])
        is_new = (np.diff(cycles[order], axis=0, prepend=-1) != 0).any(axis=1)
        groups[faces[order]] = begin + np.cumsum(is_new) - 1
        begin += int(is_new.sum())
    return groups


def _canonical(corners: Indices) -> Indices:
    """Return each cycle beginning with its lowest corner, in the direction whose second corner is lower."""
    size = corners.shape[1]
    start = corners.argmin(axis=1)[:, None]
    forward, backward = (
        np.take_along_axis(corners, (start + step * np.arange(size)) % size, axis=1) for step in (1, -1)
    )
    return np.where((forward[:, 1] <= backward[:, 1])[:, None], forward, backward)


def superfluous(mesh: PolygonMesh) -> Mask:
    """Return the faces, (f,) bool, to be removed so that no face lies exactly on another.

    Copies that are a surface said twice leave one of them: the first. Copies that are a surface folded onto
    itself, as a fin of no thickness, vanish in pairs. Which it is, is decided for copies joined by common
    edges together, by what leaves fewer edges with an odd number of faces; where nothing else is attached,
    one copy stays.
    """
    groups = copy_groups(mesh)
    _, firsts, members = np.unique(groups, return_index=True, return_inverse=True)
    counts = np.bincount(members)
    surplus = np.ones(len(members), dtype=bool)
    surplus[firsts] = False
    if not surplus.any():
        return surplus
    folded = _folded(mesh, members, counts, is_first=~surplus)
    surplus[firsts] = folded & (counts % 2 == 0)
    return surplus


def _folded(mesh: PolygonMesh, members: Indices, counts: Indices, *, is_first: Mask) -> Mask:
    """Return which groups, (g,) bool, belong to a surface folded onto itself."""
    edges = Edges.of(mesh)
    group = members[mesh.face_of_corner]
    on_first = is_first[mesh.face_of_corner]
    edge, group = edges.of_corner[on_first], group[on_first]
    copied = counts[group] > 1
    cluster = connected(len(counts) + len(edges.faces), np.column_stack([group, len(counts) + edge])[copied])
    once = np.bincount(edge, minlength=len(edges.faces))
    in_pairs = np.bincount(edge, counts[group] % 2, minlength=len(edges.faces)).astype(np.int64)
    attached = once > np.bincount(edge[copied], minlength=len(edges.faces))
    touched = np.unique(edge[copied])
    of_edge = cluster[len(counts) + touched]
    odd_once, odd_in_pairs, held = (
        np.bincount(of_edge, values[touched], minlength=cluster.max() + 1)
        for values in (once % 2, in_pairs % 2, attached)
    )
    folds = (odd_in_pairs < odd_once) & (held > 0)
    result: Mask = folds[cluster[: len(counts)]] & (counts > 1)
    return result
