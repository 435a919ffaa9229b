"""The stage `quads`: a body's own cells, or new ones, divided into tiles of the size asked for."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fabricate.duotone.catmull_clark import catmull_clark, subdivided
from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.density import FEWEST_TILES
from fabricate.prepare.remesh import Cells, remeshed
from fabricate.prepare.store import NOTHING_KEPT, Kept, Store
from fabricate.prepare.triangle_mesh import TriangleMesh, fanned
from fabricate.surface.fitting import fitted
from fabricate.surface.limit import limit_vertices
from fabricate.surface.roundness import polygons, rounded
from fabricate.surface.sizing import ENOUGH_TILES, divided, sized, tiled, typical_side


@dataclass(frozen=True, eq=False)
class Tiling:
    """Tiles in mm, and the surface they were made for.

    Attributes
    ----------
    quads : QuadMesh
    surface : TriangleMesh or None
        What new cells were made for, mm; None where the body's own cells carry the tiles.
    notes : tuple of str
        What a user should know of new cells.
    """

    quads: QuadMesh
    surface: TriangleMesh | None
    notes: tuple[str, ...]


def own_tiling(
    mesh: PolygonMesh, *, size: float, tile_size: float | None, levels: int | None, round_limit: bool
) -> Tiling:
    """Return the tiles of a body's own cells, halved until they are as near to `tile_size` mm as they get.

    `levels` counts the halvings instead. `size` is the longest side of the smooth surface, mm. With `round_limit`
    points move after the first step so that the smooth surface of a polyhedron on a sphere is round.

    Raises
    ------
    PatternError
        If the tile size does not suit the body, tiles are too many, or quads that are to be used as they are
        cannot be coloured.
    """
    steps = levels or 0
    if round_limit and levels != 0:
        mesh = polygons(rounded(catmull_clark(mesh).mesh))
        steps -= 1
    mesh = sized(mesh, size=size)
    if levels is None and tile_size is not None:
        return Tiling(tiled(mesh, tile_size=tile_size), None, ())
    return Tiling(divided(mesh, levels=steps) if steps else two_coloured(mesh), None, ())


def own_tilings(mesh: PolygonMesh, *, size: float, tile_size: float, round_limit: bool) -> tuple[Tiling, ...]:
    """Return the tilings of a body's own cells, from that nearest to `tile_size` mm to coarser and coarser ones.

    Those with tiles larger than an eighth of the body are left out, but for the first.

    Raises
    ------
    PatternError
        As `own_tiling`.
    """
    first = own_tiling(mesh, size=size, tile_size=tile_size, levels=None, round_limit=round_limit)
    coarser: list[Tiling] = []
    for levels in itertools.count(1):
        tiling = own_tiling(mesh, size=size, tile_size=None, levels=levels, round_limit=round_limit)
        if len(tiling.quads.tiles) >= len(first.quads.tiles):
            break
        if typical_side(tiling.quads) * FEWEST_TILES <= size:
            coarser.insert(0, tiling)
    return (first, *coarser)


def new_tiling(
    surface: TriangleMesh,
    *,
    cells: Cells,
    tile_size: float,
    seed: int,
    crease: float | None = None,
    progress: Callable[[str], None],
    store: Store = NOTHING_KEPT,
) -> Tiling:
    """Return tiles of new cells for a surface in mm; their smooth surface lies close to it.

    Triangles keep edges at which it turns by `crease` degrees or more, if that is not None.

    The cells are kept in the store.

    Raises
    ------
    PrepareError
        If the tile size does not suit the body, or no sound cells come out.
    """
    whole = surface.polygons

    def make() -> Kept:
        found = remeshed(whole, cells=cells, tile_size=tile_size, seed=seed, crease=crease, progress=progress)
        return Kept(found.mesh, found.notes)

    made = store.recalled(whole, f"{cells} {tile_size!r} {seed} {crease!r}", make)
    progress("fitting the smooth surface")
    quads = fitted(subdivided(made.mesh, levels=1), surface.points, surface.triangles)
    return Tiling(quads, surface, made.words)


def input_surface(mesh: PolygonMesh, *, size: float) -> TriangleMesh:
    """Return the polygons of a mesh as triangles, scaled to a longest side of `size` mm."""
    return fanned(mesh.scaled(input_scale(mesh, size=size)))


def input_scale(mesh: PolygonMesh, *, size: float) -> float:
    """Return the factor that gives a mesh a longest side of `size` mm."""
    return size / float(np.ptp(mesh.points, axis=0).max())


def smooth_surface(mesh: PolygonMesh, *, size: float, round_limit: bool) -> TriangleMesh:
    """Return the smooth surface of a coarse cage, finely tessellated, with a longest side of `size` mm."""
    quads = own_tiling(mesh, size=size, tile_size=None, levels=1, round_limit=round_limit).quads
    while len(quads.tiles) < ENOUGH_TILES:
        quads = catmull_clark(quads).mesh
    return fanned(polygons(quads).moved(limit_vertices(quads)))
