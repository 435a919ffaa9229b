"""Half-edges of a closed polygon mesh: who follows whom, and who lies on the other side."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from fabricate.arrays import Indices, frozen
from fabricate.mesh.polygon_mesh import PolygonMesh


@dataclass(frozen=True, eq=False)
class HalfEdges:
    """Connectivity of a closed, consistently oriented mesh, one entry per half-edge.

    Half-edge h runs from `tail[h]` to `tail[following[h]]` with its face on the left.

    Attributes
    ----------
    tail : (h,) int
        The point each half-edge leaves.
    following, preceding : (h,) int
        Next and previous half-edge around the same face.
    face : (h,) int
        The face on the left.
    twin : (h,) int
        The half-edge along the same edge in the opposite direction.
    """

    tail: Indices
    following: Indices
    preceding: Indices
    face: Indices
    twin: Indices

    def __post_init__(self) -> None:
        for name in ("tail", "following", "preceding", "face", "twin"):
            object.__setattr__(self, name, frozen(getattr(self, name), np.int64, (None,)))

    @property
    def edge(self) -> Indices:
        """(h,) int: number of the undirected edge, 0 to h / 2 - 1, ordered by its first half-edge."""
        first = np.minimum(np.arange(len(self.twin)), self.twin)
        number = np.cumsum(first == np.arange(len(first))) - 1
        return number[first]


def twin_half_edges(tail: Indices, head: Indices) -> Indices:
    """Return for each half-edge the one that runs the other way along the same edge, (h,) int.

    The mesh must be closed and consistently oriented (see `checked_closed`): the matrix that holds the
    number of each half-edge at (tail, head) then has the same pattern as its transpose.
    """
    count = int(tail.max(initial=-1)) + 1
    number = csr_array((np.arange(len(tail)), (tail, head)), shape=(count, count))
    number.sort_indices()
    twin = np.zeros(len(tail), dtype=np.int64)
    twin[number.data] = number.T.tocsr().data
    return twin


def half_edges(mesh: PolygonMesh) -> HalfEdges:
    """Return the half-edges of a closed polygon mesh; half-edge h is corner h of the mesh."""
    following = mesh.next_corner
    preceding = np.zeros_like(following)
    preceding[following] = np.arange(len(following))
    twin = twin_half_edges(mesh.corners, mesh.corners[following])
    return HalfEdges(mesh.corners, following, preceding, mesh.face_of_corner, twin)
