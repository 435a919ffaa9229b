"""Winding every component consistently, and outward where it is closed."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from fabricate.arrays import Indices, Mask
from fabricate.mesh.closed import volume_shares
from fabricate.mesh.edges import Edges, InnerEdges, Sheets, point_components, sheets
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.winding import fewest_flips, flipped
from fabricate.prepare.components import split
from fabricate.prepare.nesting import containers


class Oriented(NamedTuple):
    """A mesh after orientation, and the faces, (f,) bool, that were flipped; the same object if none was."""

    mesh: PolygonMesh
    flips: Mask


def oriented(mesh: PolygonMesh) -> Oriented:
    """Flip faces so that every orientable part is wound consistently and every closed component faces outward.

    Within a component as few faces as possible are flipped; then a closed component with negative volume is
    flipped as a whole. A closed component inside another is flipped along with the outermost one round it,
    so that cavities stay cavities. Components that are open, or where more than two faces share an edge, have
    no outside and only get a consistent winding as far as that goes.
    """
    if len(mesh.offsets) < 2:
        return Oriented(mesh, np.zeros(0, dtype=bool))
    edges = Edges.of(mesh)
    covers = sheets(mesh, InnerEdges.of(mesh, edges))
    flips = fewest_flips(covers)
    flips ^= _inside_out(flipped(mesh, flips), edges, covers)
    return Oriented(flipped(mesh, flips) if flips.any() else mesh, flips)


def _inside_out(mesh: PolygonMesh, edges: Edges, covers: Sheets) -> Mask:
    """Return the faces of closed, consistently wound components that have to be flipped as a whole."""
    label = _by_first_face(point_components(mesh, edges)[mesh.corners[mesh.offsets[:-1]]])
    closed = np.ones(label.max() + 1, dtype=bool)
    closed[label[mesh.face_of_corner[edges.faces[edges.of_corner] != 2]]] = False
    closed[label[covers.one_sided]] = False
    volume = np.bincount(label, volume_shares(mesh))
    negative = closed & (volume < 0)
    if not (closed & (volume > 0)).any():
        return negative[label]  # all alike: nothing to compare
    return (closed & negative[_outermost(mesh, closed, negative)])[label]


def _by_first_face(label: Indices) -> Indices:
    """Return the labels of faces renumbered in the order in which they appear, as `split` orders components."""
    _, firsts, of_face = np.unique(label, return_index=True, return_inverse=True)
    ranks: Indices = np.argsort(np.argsort(firsts))
    return ranks[of_face]


def _outermost(mesh: PolygonMesh, closed: Mask, negative: Mask) -> Indices:
    """Return for each component the outermost closed one that it lies in, itself if in none, (c,) int."""
    outermost = np.arange(len(closed))
    if not negative.any():
        return outermost
    numbers = np.flatnonzero(closed)
    parts = split(mesh)
    around = containers([parts[number] for number in numbers])
    free = np.array([not len(outer) for outer in around])
    for number, outer in zip(numbers, around, strict=True):
        if len(outer):
            outermost[number] = numbers[outer[np.argmax(free[outer])]]
    return outermost
