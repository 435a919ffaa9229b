"""Edges of a polygon mesh with any fault of topology: who meets there, wound how, and what hangs together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fabricate.arrays import Indices, Mask, frozen
from fabricate.mesh.polygon_mesh import PolygonMesh


@dataclass(frozen=True, eq=False)
class Edges:
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

    def __post_init__(self) -> None:
        object.__setattr__(self, "ends", frozen(self.ends, np.int64, (None, 2)))
        object.__setattr__(self, "of_corner", frozen(self.of_corner, np.int64, (None,)))
        object.__setattr__(self, "faces", frozen(self.faces, np.int64, (None,)))

    @classmethod
    def of(cls, mesh: PolygonMesh) -> Edges:
        """Collect the edges of a mesh, ordered by their points."""
        begins, ends = mesh.corners, mesh.corners[mesh.next_corner]
        keys = np.minimum(begins, ends) * len(mesh.points) + np.maximum(begins, ends)
        unique, of_corner, faces = np.unique(keys, return_inverse=True, return_counts=True)
        return cls(np.column_stack(np.divmod(unique, max(len(mesh.points), 1))), of_corner, faces)

    @property
    def first_corner(self) -> Indices:
        """(e,) int: the first half-edge on each edge."""
        firsts = np.zeros(len(self.faces), dtype=np.int64)
        firsts[self.of_corner[::-1]] = np.arange(len(self.of_corner))[::-1]
        return firsts


@dataclass(frozen=True, eq=False)
class InnerEdges:
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

    def __post_init__(self) -> None:
        object.__setattr__(self, "sides", frozen(self.sides, np.int64, (None, 2)))
        object.__setattr__(self, "agree", frozen(self.agree, np.bool_, (None,)))

    @classmethod
    def of(cls, mesh: PolygonMesh, edges: Edges) -> InnerEdges:
        """Pair the half-edges of a mesh."""
        by_edge = np.argsort(edges.of_corner, kind="stable")
        firsts = (np.cumsum(edges.faces) - edges.faces)[edges.faces == 2]
        sides = np.column_stack([by_edge[firsts], by_edge[firsts + 1]])
        begins = mesh.corners[sides]
        return cls(sides, begins[:, 0] != begins[:, 1])


class Sheets(NamedTuple):
    """The component of the orientation double cover that each face lies in.

    Every face has two copies, as it is and flipped; neighbours' copies that are wound consistently are joined.
    A face's copies lie in different components exactly when its part of the surface is orientable.

    Attributes
    ----------
    as_is, flipped : (f,) int
    """

    as_is: Indices
    flipped: Indices

    @property
    def one_sided(self) -> Mask:
        """(f,) bool: faces of non-orientable parts."""
        same: Mask = self.as_is == self.flipped
        return same


def sheets(mesh: PolygonMesh, inner: InnerEdges) -> Sheets:
    """Return the orientation double cover of a mesh, faces being neighbours where exactly two meet."""
    faces = len(mesh.offsets) - 1
    left, right = mesh.face_of_corner[inner.sides].T
    turned = np.where(inner.agree, 0, faces)
    links = np.concatenate(
        [np.column_stack([left, right + turned]), np.column_stack([left + faces, right + faces - turned])]
    )
    labels = connected(2 * faces, links)
    return Sheets(labels[:faces], labels[faces:])


def fans(mesh: PolygonMesh, edges: Edges) -> Indices:
    """Return the number of the fan that each corner belongs to, (h,) int.

    Corners at one point are in the same fan if a chain of faces with common edges at that point joins them,
    however many faces share an edge and however they are wound.
    """
    corner, following = np.arange(len(mesh.corners)), mesh.next_corner
    begins_low = mesh.corners == edges.ends[edges.of_corner, 0]
    at_low, at_high = np.where(begins_low, corner, following), np.where(begins_low, following, corner)
    first = edges.first_corner[edges.of_corner]
    links = [np.column_stack([at, at[first]]) for at in (at_low, at_high)]
    return connected(len(corner), np.concatenate(links))


def fans_per_point(mesh: PolygonMesh, fan: Indices) -> Indices:
    """Return the number of fans at each point, (n,) int, given that of each corner; a manifold has one."""
    _, firsts = np.unique(fan, return_index=True)
    return np.bincount(mesh.corners[firsts], minlength=len(mesh.points))


def boundary_loops(mesh: PolygonMesh, edges: Edges, fan: Indices) -> tuple[Indices, Indices]:
    """Return the half-edges without a neighbour, (b,) int, and the number of the loop of each, (b,) int.

    Two such edges follow each other in a loop if they bound the same fan, as if fans that merely touch in a
    point were apart: two sheets that do so have a loop each.
    """
    rim = np.flatnonzero(edges.faces[edges.of_corner] == 1)
    fan_ends = fan[np.column_stack([rim, mesh.next_corner[rim]])]
    _, node = np.unique(fan_ends, return_inverse=True)
    node = node.reshape(-1, 2)
    labels = connected(int(node.max(initial=-1)) + 1, node)[node[:, 0]]
    return rim, np.unique(labels, return_inverse=True)[1]


def point_components(mesh: PolygonMesh, edges: Edges) -> Indices:
    """Return the number of the component that each point lies in, (n,) int; faces join their points."""
    return connected(len(mesh.points), edges.ends)


def connected(nodes: int, links: Indices) -> Indices:
    """Return the number of the component that each node lies in, (nodes,) int, given pairs, (k, 2) int."""
    graph = coo_array((np.ones(len(links)), (links[:, 0], links[:, 1])), shape=(nodes, nodes))
    return connected_components(graph, directed=False)[1].astype(np.int64)
