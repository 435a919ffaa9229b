"""First hits of rays with a triangle mesh (Embree)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

from fabricate.arrays import Floats, Indices


class Hits(NamedTuple):
    """What each ray meets first: triangle number, or -1, (r,) int; distance in mm, or inf, (r,) float."""

    triangle: Indices
    distance: Floats


@dataclass(frozen=True, eq=False)
class RayTarget:
    """A mesh that rays are sent to, with its search tree built once."""

    scene: EmbreeScene

    @classmethod
    def of(cls, points: Floats, triangles: Indices) -> RayTarget:
        """Build the tree of triangles, (m, 3) int, on points, (n, 3) float mm."""
        scene = EmbreeScene()
        # The mesh registers itself with the scene. Points that triangles share are handed over once.
        TriangleMesh(
            scene, np.ascontiguousarray(points, dtype=np.float32), np.ascontiguousarray(triangles, dtype=np.int32)
        )
        return cls(scene)

    def first_hits(self, origins: Floats, directions: Floats) -> Hits:
        """Return the first hit of each ray, either side of a triangle counting; single precision.

        `directions`, (r, 3), must be unit vectors for the distance to be in mm.
        """
        return _hits(self.scene, origins, directions)


def first_hits(points: Floats, triangles: Indices, origins: Floats, directions: Floats) -> Hits:
    """Return the first hit of each ray with a mesh that is asked once; see `RayTarget`."""
    return RayTarget.of(points, triangles).first_hits(origins, directions)


def _hits(scene: EmbreeScene, origins: Floats, directions: Floats) -> Hits:
    found = scene.run(
        np.ascontiguousarray(origins, dtype=np.float32),
        np.ascontiguousarray(directions, dtype=np.float32),
        query="INTERSECT",
        output=True,
    )
    triangle = found["primID"].astype(np.int64)
    distance = np.where(triangle >= 0, found["tfar"].astype(np.float64), np.inf)
    return Hits(triangle, distance)
