"""Small sculptures that tests of the parts' finish share."""

from __future__ import annotations

from dataclasses import dataclass

from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.solid.assembly import Assembly, Core
from fabricate.solid.settling import fitted_cut
from fabricate.solid.solids import solids
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled


@dataclass(frozen=True, eq=False)
class Crafted:
    surface: CutSurface
    made: Assembly


def crafted(
    mesh: PolygonMesh, *, size: float, tile: float, clearance: float, core: Core = "hollow", thickness: float = 2.0
) -> Crafted:
    duotone = grown_duotone(tiled(sized(mesh, size=size), tile_size=tile), tree="random", seed=7)
    surface = fitted_cut(duotone, tolerance=0.3, clearance=clearance)
    return Crafted(surface, solids(surface, thickness=thickness, clearance=clearance, core=core))
