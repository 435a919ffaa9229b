"""Rays against triangles: a thin layer over Embree."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from fabricate.arrays import Floats, Indices, Mask
from fabricate.picture.vectors import Floats32


@dataclass(frozen=True, eq=False)
class Hits:
    """What each of (n,) rays met first.

    Attributes
    ----------
    triangle : (n,) int
        The triangle, or -1 where the ray met nothing.
    weights : (n, 3) float
        Barycentric coordinates of the point in the triangle.
    distance : (n,) float
        Along the ray, in lengths of its direction.
    """

    triangle: NDArray[np.int32]
    weights: Floats32
    distance: Floats32


class RayCaster:
    """Triangles prepared for ray queries; several threads may ask at once."""

    def __init__(self, points: Floats, triangles: Indices) -> None:
        self._scene: Any = EmbreeScene()
        # The mesh belongs to the scene from here on; Embree keeps its own copy of the coordinates.
        TriangleMesh(self._scene, points.astype(np.float32), triangles.astype(np.int32))
        # The first query builds the tree; that must be over before several threads ask.
        self._scene.run(np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32))

    def first_hits(self, origins: Floats32, directions: Floats32) -> Hits:
        """Follow rays from (n, 3) origins in (n, 3) directions to the first triangle."""
        found = self._scene.run(origins, directions, output=True)
        u, v = found["u"], found["v"]
        return Hits(found["primID"], np.stack([1 - u - v, u, v], axis=1), found["tfar"])

    def blocked(self, origins: Floats32, directions: Floats32) -> Mask:
        """(n,) bool: whether rays from (n, 3) origins in (n, 3) directions meet anything."""
        met: Mask = self._scene.run(origins, directions, query="OCCLUDED") >= 0
        return met
