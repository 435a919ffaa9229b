"""The sphere that designs are tried on: 80 triangles, round, 960 tiles."""

from __future__ import annotations

from fabricate.config import SphereConfig
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.formats.source import source_mesh
from fabricate.surface.tiling import own_tiling


def round_tiles(*, size: float = 100.0, levels: int = 2) -> QuadMesh:
    return own_tiling(source_mesh(SphereConfig()), size=size, tile_size=None, levels=levels, round_limit=True).quads
