"""A small ring that several tests divide: as a config, and as a cut surface."""

from __future__ import annotations

from functools import cache

from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.torus import torus
from fabricate.solid.settling import fitted_cut
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled

CLEARANCE = 0.3


def ring_config(*, tolerance: str) -> str:
    return f"""
[source]
shape = "torus"
size = "60 mm"
around = 8
across = 4

[pattern]
tile_size = "12 mm"
seed = 7

[solid]
thickness = "2 mm"
tolerance = "{tolerance}"
"""


@cache
def ring_surface() -> CutSurface:
    quads = tiled(sized(torus(around=8, across=4, tube=0.45), size=60), tile_size=12)
    return fitted_cut(grown_duotone(quads, tree="random", seed=3), tolerance=0.4, clearance=CLEARANCE)
