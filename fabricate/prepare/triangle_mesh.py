"""Closed triangle meshes, and the edges between their triangles."""

from __future__ import annotations

from dataclasses import dataclass

import igl
import numpy as np
from scipy.sparse import coo_array, csr_array

from fabricate.arrays import Floats, Indices, frozen
from fabricate.mesh.polygon_mesh import PolygonMesh


@dataclass(frozen=True, eq=False)
class TriangleMesh:
    """A closed, consistently oriented mesh of triangles only.

    Attributes
    ----------
    points : (n, 3) float
        mm.
    triangles : (m, 3) int
        Corners, counter-clockwise seen from outside.
    """

    points: Floats
    triangles: Indices

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen(self.points, np.float64, (None, 3)))
        object.__setattr__(self, "triangles", frozen(self.triangles, np.int64, (None, 3)))

    @property
    def polygons(self) -> PolygonMesh:
        """The same triangles as a polygon mesh."""
        corners = self.triangles.ravel()
        return PolygonMesh(self.points, corners, np.arange(0, len(corners) + 1, 3))

    @property
    def valence(self) -> Indices:
        """(n,) int: number of triangles round each point."""
        return np.bincount(self.triangles.ravel(), minlength=len(self.points))

    @property
    def fans(self) -> csr_array:
        """(n, m) matrix that is 1 where a point is a corner of a triangle."""
        columns = np.repeat(np.arange(len(self.triangles)), 3)
        entries = (np.ones(len(columns)), (self.triangles.ravel(), columns))
        return coo_array(entries, shape=(len(self.points), len(self.triangles))).tocsr()

    @property
    def area(self) -> float:
        """Area of the surface, mm2."""
        first, second, third = (self.points[self.triangles[:, k]] for k in range(3))
        return float(np.linalg.norm(np.cross(second - first, third - first), axis=1).sum() / 2.0)


@dataclass(frozen=True, eq=False)
class Edges:
    r"""The edges of a closed triangle mesh; half-edge 3 t + k runs from corner k of triangle t to the next.

             c            sides[e, 0] runs a -> b, in the triangle a b c;
           /   \          sides[e, 1] runs b -> a, in the triangle b a d
          a --- b
           \   /
             d

    Attributes
    ----------
    ends : (e, 2) int
        a and b, the lower number first.
    opposite : (e, 2) int
        c and d.
    sides : (e, 2) int
        The two half-edges.
    """

    ends: Indices
    opposite: Indices
    sides: Indices

    @property
    def triangles(self) -> Indices:
        """(e, 2) int: the triangles a b c and b a d."""
        return self.sides // 3

    @property
    def of_triangle(self) -> Indices:
        """(m, 3) int: the edges of each triangle."""
        edge = np.zeros(self.sides.size, dtype=np.int64)
        edge[self.sides] = np.arange(len(self.sides))[:, None]
        return edge.reshape(-1, 3)

    def lengths(self, points: Floats) -> Floats:
        """Return the length of each edge, (e,) float, mm."""
        lengths: Floats = np.linalg.norm(points[self.ends[:, 1]] - points[self.ends[:, 0]], axis=1)
        return lengths


def edges(mesh: TriangleMesh) -> Edges:
    """Return the edges of a closed, consistently oriented triangle mesh, ordered by their ends."""
    tail, head = mesh.triangles.ravel(), np.roll(mesh.triangles, -1, axis=1).ravel()
    keys = np.minimum(tail, head) * len(mesh.points) + np.maximum(tail, head)
    ahead, back = np.flatnonzero(tail < head), np.flatnonzero(tail > head)
    sides = np.stack([ahead[np.argsort(keys[ahead])], back[np.argsort(keys[back])]], axis=1)
    opposite = np.roll(mesh.triangles, -2, axis=1).ravel()[sides]
    return Edges(np.stack([tail[sides[:, 0]], head[sides[:, 0]]], axis=1), opposite, sides)


def adjacency(mesh: TriangleMesh, joined: Edges) -> csr_array:
    """Return the (n, n) matrix that is 1 where two points are the ends of an edge."""
    rows, columns = np.concatenate([joined.ends, joined.ends[:, ::-1]]).T
    count = len(mesh.points)
    return coo_array((np.ones(len(rows)), (rows, columns)), shape=(count, count)).tocsr()


def fanned(mesh: PolygonMesh) -> TriangleMesh:
    """Return a closed polygon mesh with every face of more than three corners as a fan round the mean of its corners.

    That keeps any closed mesh closed, whereas diagonals of two polygons may join the same two points.
    """
    sizes = mesh.face_sizes
    many = sizes > 3
    centres = np.add.reduceat(mesh.points[mesh.corners], mesh.offsets[:-1])[many] / sizes[many, None]
    centre_of_face = len(mesh.points) + np.cumsum(many) - 1
    cut = many[mesh.face_of_corner]
    begins, ends = mesh.corners[cut], mesh.corners[mesh.next_corner[cut]]
    fans = np.stack([begins, ends, centre_of_face[mesh.face_of_corner[cut]]], axis=1)
    whole = mesh.corners[~cut].reshape(-1, 3)
    return TriangleMesh(np.concatenate([mesh.points, centres]), np.concatenate([whole, fans]))


def decimated(mesh: TriangleMesh, *, triangles: int) -> TriangleMesh:
    """Return the mesh with its shortest edges collapsed until at most `triangles` are left; its genus stays.

    The mesh comes back as it is when it has no more triangles than that. Where collapsing an edge would
    change the topology the edge stays, so that a mesh of many handles may keep more triangles (libigl).
    """
    if len(mesh.triangles) <= triangles:
        return mesh
    points, kept, _, _ = igl.decimate(mesh.points, mesh.triangles, triangles)
    return TriangleMesh(points, kept)
