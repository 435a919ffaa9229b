"""Which tiles carry the pattern: a body's own cells where they do, and new ones where they are asked for or needed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.density import mostly_triangles, too_fine
from fabricate.prepare.remesh import Cells
from fabricate.prepare.store import NOTHING_KEPT, Store
from fabricate.prepare.triangle_mesh import TriangleMesh
from fabricate.surface.neck import coarse_necks
from fabricate.surface.sizing import typical_side
from fabricate.surface.tiling import (
    Tiling,
    input_surface,
    new_tiling,
    own_tiling,
    own_tilings,
    smooth_surface,
)
from fabricate.surface.widening import widened

HOPELESS = 0.7
"""The neck of a typical tile, which is 0.41 of its side on a square, is never as wide as this."""

CellChoice: TypeAlias = Literal["auto", "as-is"] | Cells


@dataclass(frozen=True)
class TileWish:
    """What is asked of the tiles.

    Attributes
    ----------
    size : float
        Longest side of the finished body, mm.
    tile_size : float or None
        Side of the tiles, mm; None counts `levels` instead.
    levels : int or None
        How often a body's own quads are divided in four.
    cells : {"auto", "as-is", "quads", "triangles", "hexagons"}
        "auto": the body's own, unless they are too fine, or give no tiling with wide enough necks.
    neck : float
        Narrowest neck that will do, mm, before clearance is taken off.
    resized : bool
        Whether coarser own cells, or new ones, may take the place of tiles with narrower necks.
    arc : float
        Where the curve crosses tile sides.
    seed : int
        Of new cells.
    cage : bool
        Whether the mesh stands for a smooth surface, as the built-in shapes do.
    round_limit : bool
        Whether it is a polyhedron that stands for a ball.
    """

    size: float
    tile_size: float | None
    levels: int | None
    cells: CellChoice
    neck: float
    resized: bool
    arc: float
    seed: int
    cage: bool
    round_limit: bool


def chosen_tiling(
    mesh: PolygonMesh,
    wish: TileWish,
    *,
    grow: Callable[[QuadMesh], Duotone],
    progress: Callable[[str], None],
    store: Store = NOTHING_KEPT,
) -> Tiling:
    """Return the tiles of a body that suit a wish best, in mm.

    New cells are made for the surface of a scan, which is one of triangles, or of any mesh for which new cells are
    asked for by name; and for the smooth surface of a cage whose own ones don't do.

    Parameters
    ----------
    mesh : PolygonMesh
        One closed surface, in any unit.
    wish : TileWish
    grow : callable
        Joins the tiles of quads to a duotone, whose necks are measured.
    progress : callable
        Told what begins.
    store : Store
        Keeps new cells.

    Raises
    ------
    PatternError
        If the tile size does not suit the body, tiles are too many, or quads that are to be used as they are
        cannot be coloured.
    PrepareError
        If no sound new cells come out.
    """
    cells, tile_size = wish.cells, wish.tile_size
    if tile_size is None:
        return own_tiling(mesh, size=wish.size, tile_size=None, levels=wish.levels, round_limit=wish.round_limit)
    notes: tuple[str, ...] = ()
    if cells == "as-is" or (cells == "auto" and not too_fine(mesh, size=wish.size, tile_size=tile_size)):
        own = own_tilings(mesh, size=wish.size, tile_size=tile_size, round_limit=wish.round_limit)
        wide = _first_with_necks(own, wish.neck, wish.arc, grow) if wish.resized else own[0]
        if wide is not None or cells == "as-is":
            return wide or own[0]
        notes = (f"no division of the mesh's own cells has necks of {wish.neck:.3g} mm: the cells are new quads",)
    whole = _surface(mesh, wish)
    kind: Cells = "quads" if cells == "auto" else cells
    made = new_tiling(whole, cells=kind, tile_size=tile_size, seed=wish.seed, progress=progress, store=store)
    progress("widening narrow tiles")
    quads = widened(made.quads, whole, arc=wish.arc, neck=wish.neck)
    return replace(made, quads=quads, notes=notes + made.notes)


def _surface(mesh: PolygonMesh, wish: TileWish) -> TriangleMesh:
    """Return the surface that new cells stand for, mm."""
    if wish.cage or (wish.cells == "auto" and not mostly_triangles(mesh)):
        return smooth_surface(mesh, size=wish.size, round_limit=wish.round_limit)
    return input_surface(mesh, size=wish.size)


def _first_with_necks(
    tilings: tuple[Tiling, ...], neck: float, arc: float, grow: Callable[[QuadMesh], Duotone]
) -> Tiling | None:
    """Return the first tiling without a neck narrower than asked, mm, if there is one; a coarser one says so."""
    for tiling in tilings:
        if HOPELESS * typical_side(tiling.quads) < neck:
            continue
        if coarse_necks(grow(tiling.quads), arc=arc).min() >= neck:
            note = f"tiles are larger: the cells are uneven, and the narrowest neck has to be {neck:.3g} mm wide"
            return tiling if tiling is tilings[0] else replace(tiling, notes=(note, *tiling.notes))
    return None
