"""Scaling a mesh so that the finished sculpture, not its cage, has the size asked for."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats
from fabricate.duotone.catmull_clark import catmull_clark, subdivided
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.errors import PatternError
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.surface.limit import limit_vertices

ENOUGH_TILES = 20_000
"""Limit points from which the bounding box is read: off by about 1e-4 of the size on smooth shapes."""

MAX_TILES = 4_000_000
"""More tiles than this are out of reach of memory in the stages that follow."""


def sized(mesh: PolygonMesh, *, size: float) -> PolygonMesh:
    """Return the mesh scaled so that the longest side of its limit surface's bounding box is `size` mm."""
    return mesh.scaled(smooth_scale(mesh, size=size))


def smooth_scale(mesh: PolygonMesh, *, size: float) -> float:
    """Return the factor that gives the limit surface of a mesh a longest side of `size` mm."""
    quads = subdivided(mesh, levels=1)
    while len(quads.tiles) < ENOUGH_TILES:
        quads = catmull_clark(quads).mesh
    limit = limit_vertices(quads)
    return size / float(np.ptp(limit, axis=0).max())


def tile_sides(quads: QuadMesh) -> Floats:
    """Return the straight length of each tile side on the limit surface, (4 t,) float, mm."""
    corners = limit_vertices(quads)[quads.tiles]
    sides: Floats = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2).ravel()
    return sides


def typical_side(quads: QuadMesh) -> float:
    """Return the median side of the tiles on the limit surface, mm."""
    return float(np.median(tile_sides(quads)))


def tiled(mesh: PolygonMesh, *, tile_size: float) -> QuadMesh:
    """Return the mesh subdivided until its median tile side is as near to `tile_size` mm as it gets.

    There is at least one Catmull-Clark step. Each halves the sides, so the result is within about a factor of
    the square root of 2 of what was asked, unless the mesh's own faces are smaller than that already.

    Raises
    ------
    PatternError
        If the tile size is not positive or larger than the body, or needs more tiles than memory holds.
    """
    extent = float(np.ptp(mesh.points, axis=0).max())
    if not 0.0 < tile_size <= extent:
        raise PatternError(
            f"a tile size must be positive and no larger than the body, which is {extent:.4g} mm long; "
            f"found {tile_size:g} mm"
        )
    quads = subdivided(mesh, levels=1)
    miss = _miss(quads, tile_size)
    while miss > 0.0:
        if 4 * len(quads.tiles) > MAX_TILES:
            raise PatternError(
                f"tiles of {tile_size:g} mm would be more than {MAX_TILES}; ask for a larger pattern.tile_size"
            )
        finer = catmull_clark(quads).mesh
        finer_miss = _miss(finer, tile_size)
        if abs(finer_miss) > miss:
            break
        quads, miss = finer, finer_miss
    return quads


def divided(mesh: PolygonMesh, *, levels: int) -> QuadMesh:
    """Return the mesh after `levels` >= 1 Catmull-Clark steps.

    Raises
    ------
    PatternError
        If that is more tiles than memory holds.
    """
    tiles = len(mesh.corners) * 4 ** (levels - 1)
    if tiles > MAX_TILES:
        raise PatternError(
            f"{levels} levels of a mesh with {len(mesh.corners)} corners would be {tiles} tiles, "
            f"more than {MAX_TILES}; ask for a smaller pattern.levels"
        )
    return subdivided(mesh, levels=levels)


def _miss(quads: QuadMesh, tile_size: float) -> float:
    """Return by how many halvings the median tile side is too long, negative when it is too short."""
    return float(np.log2(typical_side(quads) / tile_size))
