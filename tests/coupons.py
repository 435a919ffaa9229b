"""Small fit coupons that several tests look at, each made once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Literal, TypeAlias

from fabricate.arrays import Mask
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus
from fabricate.solid.assembly import Assembly, Core
from fabricate.solid.coupon import Coupon, coupon
from fabricate.solid.settling import fitted_cut
from fabricate.solid.solids import solids
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled

CLEARANCE, THICKNESS, WALL = 0.3, 2.0, 0.8

Name: TypeAlias = Literal["ring", "core", "bands"]


@dataclass(frozen=True, eq=False)
class Subject:
    """A small sculpture: its cut surface, which of its tiles are yellow-joined, and what keeps the inside."""

    surface: CutSurface
    joined: Mask
    core: Core

    def solids(self, clearance: float) -> Assembly:
        return solids(self.surface, thickness=THICKNESS, clearance=clearance, core=self.core)


_BODIES: dict[Name, tuple[PolygonMesh, float, float, tuple[float, ...], Core]] = {
    "ring": (torus(around=8, across=4, tube=0.45), 60.0, 12.0, (0.5,), "hollow"),
    "core": (sphere(faces="hexagons"), 60.0, 12.0, (0.5,), "blue"),
    "bands": (sphere(faces="hexagons"), 90.0, 18.0, (0.36, 0.5, 0.615), "hollow"),
}


@cache
def subject(name: Name) -> Subject:
    """Return a ring, a ball with a core, or a ball of four regions."""
    mesh, size, tile, rings, core = _BODIES[name]
    duotone = grown_duotone(tiled(sized(mesh, size=size), tile_size=tile), tree="random", seed=7)
    surface = fitted_cut(duotone, rings=rings, tolerance=0.3, clearance=CLEARANCE)
    return Subject(surface, duotone.joined, core)


@cache
def tried(name: Name) -> Coupon:
    """Return the coupon of a small sculpture."""
    of = subject(name)
    return coupon(of.surface, of.joined, of.solids, clearance=CLEARANCE, core=of.core, wall=WALL)
