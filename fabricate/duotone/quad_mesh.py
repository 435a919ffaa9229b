"""Quads whose corners alternate between yellow and blue: the mesh that carries the tiles."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, connected_components

from fabricate.arrays import Floats, Indices, Mask, frozen
from fabricate.errors import PatternError
from fabricate.mesh.half_edges import HalfEdges, half_edges
from fabricate.mesh.polygon_mesh import PolygonMesh

NAMED = 12
"""Of a longer odd cycle a message names only as many points."""


@dataclass(frozen=True, eq=False)
class QuadMesh:
    r"""A closed mesh of two-coloured quads; each quad is one Truchet tile.

    Every tile lists its corners counter-clockwise seen from outside and begins at a yellow one:

        b3 --<-- y2             half-edge 4 t + k is side k of tile t,
         |   2    |             from corner k to corner (k + 1) mod 4;
         v 3 t  1 ^             sides 0 and 2 run from yellow to blue,
         |   0    |             sides 1 and 3 from blue to yellow
        y0 -->-- b1

    Attributes
    ----------
    points : (n, 3) float
        Control points, mm.
    tiles : (t, 4) int
        Corners: yellow, blue, yellow, blue.
    twins : (4 t,) int
        The half-edge on the other side of each half-edge.
    yellow : (n,) bool
        True at yellow points, False at blue ones.
    creases : (4 t,) bool
        True on both half-edges of every tile side that stays sharp when the mesh is subdivided; by default on none.
    """

    points: Floats
    tiles: Indices
    twins: Indices
    yellow: Mask
    creases: Mask = field(default_factory=lambda: np.zeros(0, dtype=bool))

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen(self.points, np.float64, (None, 3)))
        object.__setattr__(self, "tiles", frozen(self.tiles, np.int64, (None, 4)))
        object.__setattr__(self, "twins", frozen(self.twins, np.int64, (4 * len(self.tiles),)))
        object.__setattr__(self, "yellow", frozen(self.yellow, np.bool_, (len(self.points),)))
        creases = self.creases if len(self.creases) else np.zeros(4 * len(self.tiles), dtype=bool)
        object.__setattr__(self, "creases", frozen(creases, np.bool_, (4 * len(self.tiles),)))

    @property
    def half_edges(self) -> HalfEdges:
        """The same connectivity as for any polygon mesh."""
        h = np.arange(4 * len(self.tiles))
        following = h + 1 - 4 * (h % 4 == 3)
        preceding = h - 1 + 4 * (h % 4 == 0)
        return HalfEdges(self.tiles.ravel(), following, preceding, h // 4, self.twins)

    @property
    def crease_counts(self) -> Indices:
        """(n,) int: number of creases that meet at each point: 1 at a dart, 2 on a crease, more at a corner."""
        return np.bincount(self.tiles.ravel()[self.creases], minlength=len(self.points))

    @property
    def genus(self) -> int:
        """Number of handles, from Euler's formula V - 2 T + T = 2 - 2 g."""
        return (2 - len(self.points) + len(self.tiles)) // 2


def two_coloured(mesh: PolygonMesh) -> QuadMesh:
    """Return a closed pure quad mesh as it is, with its points coloured yellow and blue in turn.

    Point 0 becomes yellow. Points keep their numbers; each quad is turned to begin at a yellow corner.

    Raises
    ------
    PatternError
        If a face is not a quad, or if the points cannot be coloured; then an odd cycle is named.
    """
    sizes = mesh.face_sizes
    if (sizes != 4).any():
        face = int(np.argmax(sizes != 4))
        raise PatternError(
            f"levels = 0 needs a mesh of quads only, found {int((sizes != 4).sum())} other faces, "
            f"the first is face {face} with {sizes[face]} corners; use levels = 1 or more"
        )
    connectivity = half_edges(mesh)
    tail, head = connectivity.tail, connectivity.tail[connectivity.following]
    quads = mesh.corners.reshape(-1, 4)
    yellow = _colours(quads, tail, head, len(mesh.points))
    turned = ~yellow[quads[:, 0]]
    sides = np.arange(len(mesh.corners)).reshape(-1, 4)
    old = np.where(turned[:, None], np.roll(sides, -1, axis=1), sides).ravel()
    renumbered = np.zeros_like(old)
    renumbered[old] = np.arange(len(old))
    twins = renumbered[connectivity.twin[old]]
    return QuadMesh(mesh.points, mesh.corners[old].reshape(-1, 4), twins, yellow, mesh.creases[old])


def _colours(quads: Indices, tail: Indices, head: Indices, count: int) -> Mask:
    """Return which points share point 0's colour, from the graph of the quads' diagonals.

    All neighbours of a point are connected along diagonals, so on a connected surface this graph has two
    components, which are the colours, or only one: then some edge joins equals and an odd cycle exists.
    """
    rows, columns = quads[:, :2].ravel(), quads[:, 2:].ravel()
    diagonals = coo_array((np.ones(len(rows)), (rows, columns)), shape=(count, count))
    components, labels = connected_components(diagonals, directed=False)
    if components == 1:
        cycle = _odd_cycle(tail, head, count)
        named = [*cycle, cycle[0]] if len(cycle) <= NAMED else [*cycle[: NAMED - 1], "...", cycle[-1], cycle[0]]
        names = " - ".join(str(point) for point in named)
        raise PatternError(
            f"the quads cannot be coloured in two colours: points {names} form an odd cycle of "
            f"{len(cycle)} edges; use levels = 1 or more"
        )
    same: Mask = labels == labels[0]
    return same


def _odd_cycle(tail: Indices, head: Indices, count: int) -> list[int]:
    """Return the points of one odd cycle: an edge between equal depths closes two tree paths."""
    graph = coo_array((np.ones(len(tail)), (tail, head)), shape=(count, count)).tocsr()
    order, parent = breadth_first_order(graph, 0, directed=False)
    depth = np.zeros(count, dtype=np.int64)
    for point in order[1:]:
        depth[point] = depth[parent[point]] + 1
    odd = np.flatnonzero(depth[tail] == depth[head])
    first = odd[np.argmin(depth[tail[odd]])]
    left, right = [int(tail[first])], [int(head[first])]
    while left[-1] != right[-1]:
        left.append(int(parent[left[-1]]))
        right.append(int(parent[right[-1]]))
    return left + right[-2::-1]
