"""Meshes of triangles that a file places somewhere, perhaps several times, and the one mesh that they make."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices, frozen
from fabricate.mesh.polygon_mesh import PolygonMesh


@dataclass(frozen=True, eq=False)
class Piece:
    """Triangles and where they are placed.

    Attributes
    ----------
    points : (n, 3) float
        Positions in the piece's own frame.
    triangles : (t, 3) int
        Points of each triangle.
    transform : (4, 4) float
        The place of (x, y, z) is the begin of (x, y, z, 1) @ transform; the last column is not used.
    """

    points: Floats
    triangles: Indices
    transform: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen(self.points, np.float64, (None, 3)))
        object.__setattr__(self, "triangles", frozen(self.triangles, np.int64, (None, 3)))
        object.__setattr__(self, "transform", frozen(self.transform, np.float64, (4, 4)))


def joined(pieces: Sequence[Piece]) -> PolygonMesh:
    """Return one mesh of all pieces where they are placed; triangles that are mirrored keep their outside."""
    begins = np.cumsum([0, *(len(piece.points) for piece in pieces)])
    points = [np.zeros((0, 3)), *(_placed_points(piece) for piece in pieces)]
    triangles = [np.zeros((0, 3), dtype=np.int64)]
    triangles += [_outward(piece) + begin for piece, begin in zip(pieces, begins, strict=False)]
    corners = np.concatenate(triangles).ravel()
    return PolygonMesh(np.concatenate(points), corners, np.arange(0, len(corners) + 1, 3))


def _placed_points(piece: Piece) -> Floats:
    if np.array_equal(piece.transform, np.eye(4)):
        return piece.points
    # one sum for all points, as a matrix product may round equal points differently
    x, y, z = piece.points.T[:, :, None]
    right, up, front, shift = piece.transform[:, :3]
    with np.errstate(over="ignore", invalid="ignore"):  # infinities are judged later, like all others
        placed: Floats = x * right + y * up + z * front + shift
    return placed


def _outward(piece: Piece) -> Indices:
    with np.errstate(over="ignore", invalid="ignore"):
        right, up, front = piece.transform[:3, :3]
        mirrored = np.dot(np.cross(right, up), front) < 0
    return piece.triangles[:, [0, 2, 1]] if mirrored else piece.triangles
