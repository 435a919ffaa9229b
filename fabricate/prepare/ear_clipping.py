"""Polygons cut into triangles on their own corners, by ear clipping, many polygons at a time."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.triangles.normals import unit

LARGEST_CLIPPED = 2000
"""Polygons with more corners become plain fans: the cost of clipping grows with the square of their number."""

_BLOCK = 1 << 19
"""Corners that are worked on together; bounds the memory."""

_NOT_AN_EAR = -8.0
"""Added to the quality of corners that cannot be cut off properly: they are only taken if nothing else is left."""


class EarClipping(NamedTuple):
    """Triangles, (t, 3) int, wound as their polygons, and the polygon that each lies in, (t,) int, ascending."""

    triangles: Indices
    face: Indices


def ear_clipped(mesh: PolygonMesh) -> EarClipping:
    """Cut every polygon of at least 3 corners into triangles.

    Ears are cut off in the plane that fits the polygon best, the one with the best shape first, so that of a
    bent quad's two diagonals it is mostly the shorter one, and concave polygons stay within their outline.
    A polygon that crosses itself gets triangles, too, but these overlap.
    """
    sizes = mesh.face_sizes
    parts = [_group(mesh, np.flatnonzero(sizes == size), size) for size in np.unique(sizes[sizes >= 3]).tolist()]
    triangles = np.concatenate([part.triangles for part in parts] or [np.zeros((0, 3), dtype=np.int64)])
    face = np.concatenate([part.face for part in parts] or [np.zeros(0, dtype=np.int64)])
    order = np.argsort(face, kind="stable")
    return EarClipping(triangles[order], face[order])


def _group(mesh: PolygonMesh, faces: Indices, size: int) -> EarClipping:
    corners = mesh.corners[mesh.offsets[faces][:, None] + np.arange(size)]
    if size == 3:
        return EarClipping(corners, faces)
    rows = max(_BLOCK // size, 1)
    blocks = [corners[begin : begin + rows] for begin in range(0, len(corners), rows)]
    places = np.concatenate([_cut(mesh.points[block]) for block in blocks])
    triangles = np.take_along_axis(corners[:, None, :], places, axis=2)
    return EarClipping(triangles.reshape(-1, 3), np.repeat(faces, size - 2))


def _cut(polygons: Floats) -> Indices:
    """Return the triangles of k polygons of n corners, (k, n, 3) float, as places of corners, (k, n - 2, 3)."""
    count, size, _ = polygons.shape
    if size > LARGEST_CLIPPED:
        fan = np.arange(1, size - 1)
        return np.broadcast_to(np.column_stack([np.zeros_like(fan), fan, fan + 1]), (count, size - 2, 3))
    return _Clipping(_flattened(polygons)).clipped()


def _flattened(polygons: Floats) -> Floats:
    """Return the polygons, (k, n, 2), in the plane across their area vectors, counter-clockwise."""
    around = polygons - polygons.mean(axis=1, keepdims=True)
    normals = unit(np.cross(around, np.roll(around, -1, axis=1)).sum(axis=1))
    first = unit(np.cross(normals, np.eye(3)[np.abs(normals).argmin(axis=1)]))
    second = np.cross(normals, first)
    return np.stack([np.einsum("knj,kj->kn", around, axis) for axis in (first, second)], axis=2)


class _Clipping:
    """Rings of corners that get shorter ear by ear; one row per polygon."""

    def __init__(self, flat: Floats) -> None:
        count, size, _ = flat.shape
        places = np.broadcast_to(np.arange(size), (count, size))
        self.flat, self.rows = flat, np.arange(count)
        self.before, self.after = np.roll(places, 1, axis=1).copy(), np.roll(places, -1, axis=1).copy()
        self.alive = np.ones((count, size), dtype=bool)
        self.score = np.zeros((count, size))
        for place in range(size):
            self._judge(np.full(count, place))

    def clipped(self) -> Indices:
        """Return (k, n - 2, 3) places of corners; uses the rings up."""
        count, size, _ = self.flat.shape
        triangles = np.zeros((count, size - 2, 3), dtype=np.int64)
        for step in range(size - 2):
            tip = self.score.argmax(axis=1)
            a, b = self.before[self.rows, tip], self.after[self.rows, tip]
            triangles[:, step] = np.column_stack([a, tip, b])
            self.after[self.rows, a], self.before[self.rows, b] = b, a
            self.alive[self.rows, tip], self.score[self.rows, tip] = False, -np.inf
            if step < size - 3:
                self._judge(a)
                self._judge(b)
        return triangles

    def _judge(self, tip: Indices) -> None:
        """Set how well a corner of each polygon can be cut off: the shape of its triangle, if that is an ear."""
        ends = [self.before[self.rows, tip], tip, self.after[self.rows, tip]]
        a, t, b = (self.flat[self.rows, end] for end in ends)
        area = _cross(t - a, b - a)
        sides = ((t - a) ** 2 + (b - t) ** 2 + (a - b) ** 2).sum(axis=1)
        quality = area / np.maximum(sides, np.finfo(float).tiny)
        is_ear = (area > 0.0) & ~self._occupied(a, t, b)
        self.score[self.rows, tip] = np.where(is_ear, quality, quality + _NOT_AN_EAR)

    def _occupied(self, a: Floats, t: Floats, b: Floats) -> Mask:
        """Return whether another corner lies in or on each triangle, (k,) bool; those at its own corners don't."""
        outside = ~self.alive
        for begin, end in ((a, t), (t, b), (b, a)):
            to_point = self.flat - begin[:, None]
            outside |= _cross((end - begin)[:, None], to_point) < 0.0
            outside |= (to_point[..., 0] == 0.0) & (to_point[..., 1] == 0.0)
        occupied: Mask = np.logical_not(outside.all(axis=1))
        return occupied


def _cross(first: Floats, second: Floats) -> Floats:
    product: Floats = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
    return product
