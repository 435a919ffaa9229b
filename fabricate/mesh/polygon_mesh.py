"""The polygon mesh that enters the line: faces with any number of corners, kept as they came."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from fabricate.arrays import Floats, Indices, Mask, frozen


@dataclass(frozen=True, eq=False)
class PolygonMesh:
    r"""Points and polygons of any size.

    Face f has the corners `corners[offsets[f]:offsets[f + 1]]`, counter-clockwise seen from outside.
    Corner h is also *half-edge* h: it runs from its own point to that of the next corner in the face.

        p3 ---<--- p2          corners = [p0, p1, p2, p3, ...]
        |     h2    |          half-edge h0 runs p0 -> p1, and its twin lies in the
        v h3  f  h1 ^          neighbouring face and runs p1 -> p0
        |     h0    |
        p0 --->--- p1

    Attributes
    ----------
    points : (n, 3) float
        Positions. Their unit is the file's until the mesh is sized; mm afterwards.
    corners : (h,) int
        Point index of each corner, face after face.
    offsets : (f + 1,) int
        Where each face begins in `corners`; the last entry is the number of corners.
    creases : (h,) bool
        True on both half-edges of every edge that stays sharp when the mesh is subdivided; by default on none.
    """

    points: Floats
    corners: Indices
    offsets: Indices
    creases: Mask = field(default_factory=lambda: np.zeros(0, dtype=bool))

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen(self.points, np.float64, (None, 3)))
        object.__setattr__(self, "corners", frozen(self.corners, np.int64, (None,)))
        object.__setattr__(self, "offsets", frozen(self.offsets, np.int64, (None,)))
        creases = self.creases if len(self.creases) else np.zeros(len(self.corners), dtype=bool)
        object.__setattr__(self, "creases", frozen(creases, np.bool_, (len(self.corners),)))

    @classmethod
    def from_faces(cls, points: ArrayLike, faces: Iterable[Sequence[int]]) -> PolygonMesh:
        """Build from a sequence of faces, each a sequence of point indices."""
        polygons = [np.asarray(face, dtype=np.int64) for face in faces]
        sizes = np.array([len(polygon) for polygon in polygons], dtype=np.int64)
        corners = np.concatenate(polygons) if polygons else np.zeros(0, dtype=np.int64)
        return cls(np.asarray(points, dtype=np.float64), corners, np.concatenate([[0], np.cumsum(sizes)]))

    @property
    def face_sizes(self) -> Indices:
        """(f,) int: number of corners of each face."""
        return np.diff(self.offsets)

    @property
    def face_of_corner(self) -> Indices:
        """(h,) int: the face that each corner belongs to."""
        return np.repeat(np.arange(len(self.offsets) - 1), self.face_sizes)

    @property
    def next_corner(self) -> Indices:
        """(h,) int: the corner that follows in the same face."""
        following = np.arange(1, len(self.corners) + 1)
        filled = self.face_sizes > 0
        following[self.offsets[1:][filled] - 1] = self.offsets[:-1][filled]
        return following

    def moved(self, points: Floats) -> PolygonMesh:
        """Return the same polygons and creases on other points."""
        return PolygonMesh(points, self.corners, self.offsets, self.creases)

    def scaled(self, factor: float) -> PolygonMesh:
        """Return the mesh with every coordinate multiplied by `factor`."""
        return self.moved(self.points * factor)
