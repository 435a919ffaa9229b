"""Which tiles carry the pattern: a body's own cells where they do, and new ones where they are asked for or needed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple, TypeAlias

from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.density import mostly_triangles, too_fine
from fabricate.prepare.remesh import Cells
from fabricate.prepare.store import NOTHING_KEPT, Store
from fabricate.prepare.thin_handles import without_thin_handles
from fabricate.prepare.tile_quality import tile_quality
from fabricate.prepare.triangle_mesh import TriangleMesh
from fabricate.surface.neck import coarse_necks
from fabricate.surface.sizing import smooth_scale, typical_side
from fabricate.surface.tile_places import TilePlaces
from fabricate.surface.tiling import (
    Tiling,
    input_scale,
    input_surface,
    new_tiling,
    own_tiling,
    own_tilings,
    smooth_surface,
)
from fabricate.surface.widening import widened

HOPELESS = 0.7
"""The neck of a typical tile, which is 0.41 of its side on a square, is never as wide as this."""

MOST_NARROW = 0.1
"""Own cells are kept with no larger a share of necks that have no room for the clearance; and a cage's with no larger a
share that are too narrow to print, where new quads do not come out as asked for."""

LARGER = (1.15, 1.3)
"""How many times as large as asked for new tiles are made in turn until none has a narrow neck, if they may be."""

FEW_NARROW, FEWER = 0.05, 0.5
"""Larger tiles are tried when no larger a share of the necks is narrow than this, as more come from a body that is too
thin; and taken when it falls to this share of what it was."""

LONG = 2.0
"""Triangles are no cells to keep, if tiles may be resized, when 1 tile in 20 is longer than so many times its width."""

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
        "auto": the body's own, unless they are too fine, have no room for the clearance, or, if tiles may be resized,
        give no tiling with wide enough necks.
    neck : float
        Narrowest neck that will do, mm, before clearance is taken off.
    depth : float
        How far under the surface necks have to be as wide, mm.
    clearance : float
        Gap between facing walls, mm.
    thinnest : float
        Handles thinner and holes narrower than this, mm, get no new cells: the surface is made without them.
    resized : bool
        Whether coarser own cells, or new ones, may take the place of tiles with narrower necks.
    rings : tuple of float
        Where the curve crosses tile sides.
    seed : int
        Of new cells.
    crease : float or None
        Edges at which the body turns by so many degrees or more stay sharp.
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
    depth: float
    clearance: float
    thinnest: float
    resized: bool
    rings: tuple[float, ...]
    seed: int
    crease: float | None
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

    A cage's own cells slide over its smooth surface if that makes their necks wide. New cells are made for the surface
    of a scan, which is one of triangles, or of any mesh for which new cells are asked for by name; and for the smooth
    surface of a cage whose own ones don't do.

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
    if cells == "as-is" or (cells == "auto" and not too_fine(mesh, size=wish.size, tile_size=tile_size)):
        own = own_tilings(mesh, size=wish.size, tile_size=tile_size, round_limit=wish.round_limit)
        suited = _suited(own, mesh, wish, grow)
        if suited is not None or cells == "as-is":
            return suited or own[0]
        return _instead_of(own, mesh, wish, tile_size, grow=grow, progress=progress, store=store)
    kind: Cells = "quads" if cells == "auto" else cells
    return _new(mesh, wish, kind, tile_size, grow=grow, progress=progress, store=store).tiling


class _New(NamedTuple):
    """New tiles, the share of their necks that is too narrow, and whether they are otherwise than asked for."""

    tiling: Tiling
    narrow: float
    flawed: bool


def _new(
    mesh: PolygonMesh,
    wish: TileWish,
    cells: Cells,
    tile_size: float,
    *,
    grow: Callable[[QuadMesh], Duotone],
    progress: Callable[[str], None],
    store: Store,
) -> _New:
    """Return new cells, widened, for the surface without its thin handles: larger ones for wide necks, if they may."""
    simplified = without_thin_handles(sized_surface(mesh, wish), thinnest=wish.thinnest)
    kind, instead = (cells, ()) if not mesh.creases.any() else _along_creases(cells)

    def make(side: float) -> Tiling:
        whole = simplified.surface
        made = new_tiling(
            whole, cells=kind, tile_size=side, seed=wish.seed, crease=wish.crease, progress=progress, store=store
        )
        progress("widening narrow tiles")
        quads = widened(made.quads, whole, rings=wish.rings, neck=wish.neck, depth=wish.depth)
        return replace(made, quads=quads)

    found = make(tile_size)
    note: tuple[str, ...] = ()
    narrow = _narrow_share(found.quads, wish, grow)
    for times in LARGER:
        if found.notes or not wish.resized or not 0.0 < narrow <= FEW_NARROW:
            break
        larger = make(times * tile_size)
        share = _narrow_share(larger.quads, wish, grow)
        if share <= FEWER * narrow and not larger.notes:
            found, narrow = larger, share
            note = (f"tiles are larger, {times * tile_size:.3g} mm, so that necks are {wish.neck:.3g} mm wide",)
    flawed = bool(simplified.notes or found.notes)
    return _New(replace(found, notes=(*simplified.notes, *instead, *note, *found.notes)), narrow, flawed)


def _along_creases(cells: Cells) -> tuple[Cells, tuple[str, ...]]:
    """Return the kind of new cells for a body with creases, and what has to be said of it."""
    if cells == "quads":
        return "triangles", ("new quads do not keep sharp edges: the cells are triangles instead",)
    if cells == "hexagons":
        return cells, ("new hexagons do not keep sharp edges: those of prepare.crease are rounded",)
    return cells, ()


def _narrow_share(quads: QuadMesh, wish: TileWish, grow: Callable[[QuadMesh], Duotone]) -> float:
    """Return the share of the necks that are narrower than asked for."""
    return float((coarse_necks(grow(quads), rings=wish.rings, depth=wish.depth) < wish.neck).mean())


def _instead_of(
    own: tuple[Tiling, ...],
    mesh: PolygonMesh,
    wish: TileWish,
    tile_size: float,
    *,
    grow: Callable[[QuadMesh], Duotone],
    progress: Callable[[str], None],
    store: Store,
) -> Tiling:
    """Return what takes the place of own tilings none of which has wide necks.

    A cage's own cells slid over its surface, if that widens all of them, or if new quads come out otherwise than asked
    for and have more narrow necks; else new quads.
    """
    slid, narrow = (None, 1.0) if mostly_triangles(mesh) else _slid(own, mesh, wish, grow=grow, progress=progress)
    if slid is not None and narrow == 0.0:
        return slid
    made = _new(mesh, wish, "quads", tile_size, grow=grow, progress=progress, store=store)
    if slid is not None and made.flawed and narrow <= max(MOST_NARROW, made.narrow):
        return slid
    note = (
        f"no division of the mesh's own cells has necks of {wish.neck:.3g} mm: the cells are new quads"
        if wish.resized
        else f"the clearance of {wish.clearance:g} mm does not fit into the mesh's own cells: they are new quads"
    )
    return replace(made.tiling, notes=(note, *made.tiling.notes))


def _slid(
    own: tuple[Tiling, ...],
    mesh: PolygonMesh,
    wish: TileWish,
    *,
    grow: Callable[[QuadMesh], Duotone],
    progress: Callable[[str], None],
) -> tuple[Tiling | None, float]:
    """Return a cage's own tiling, widened, with the smallest share of narrow necks, and that share."""
    progress("widening narrow tiles")
    surface = smooth_surface(mesh, size=wish.size, round_limit=wish.round_limit)
    hopeful = [tiling for tiling in own if HOPELESS * typical_side(tiling.quads) >= wish.neck]
    slid = [widened(tiling.quads, surface, rings=wish.rings, neck=wish.neck, depth=wish.depth) for tiling in hopeful]
    shares = [_narrow_share(quads, wish, grow) for quads in slid]
    if not shares:
        return None, 1.0
    least = min(shares)
    note = f"the mesh's own cells slid over its surface until their necks were {wish.neck:.3g} mm wide"
    note += f", but for {least:.1%} of them" if least > 0.0 else ""
    return Tiling(slid[shares.index(least)], surface, (note,)), least


def tile_scale(mesh: PolygonMesh, wish: TileWish, tiling: Tiling | None = None) -> float:
    """Return how many mm a unit of a body's mesh is in its tiling, or in one of its own cells."""
    if tiling is None or tiling.surface is None or _is_cage(mesh, wish):
        return smooth_scale(mesh, size=wish.size)
    return input_scale(mesh, size=wish.size)


def _is_cage(mesh: PolygonMesh, wish: TileWish) -> bool:
    """Return whether a mesh stands for its smooth surface, and not for itself."""
    return wish.cage or (wish.cells == "auto" and not mostly_triangles(mesh))


def sized_surface(mesh: PolygonMesh, wish: TileWish) -> TriangleMesh:
    """Return the surface that a mesh stands for, mm: a cage's smooth one, or its own."""
    if _is_cage(mesh, wish):
        return smooth_surface(mesh, size=wish.size, round_limit=wish.round_limit)
    return input_surface(mesh, size=wish.size)


def _suited(
    own: tuple[Tiling, ...], mesh: PolygonMesh, wish: TileWish, grow: Callable[[QuadMesh], Duotone]
) -> Tiling | None:
    """Return the own tiling to take, if any: of the size asked for it only has to have room for the clearance."""
    if wish.resized:
        even = own if not mostly_triangles(mesh) else tuple(tiling for tiling in own if _is_even(tiling.quads))
        return _first_with_necks(even, wish, grow)
    if wish.cells == "as-is":
        return own[0]
    without_room = coarse_necks(grow(own[0].quads), rings=wish.rings) <= wish.clearance
    return own[0] if without_room.mean() <= MOST_NARROW else None


def _is_even(quads: QuadMesh) -> bool:
    """Return whether hardly a tile is so long that bands are uneven, as they are on a program's long triangles."""
    return tile_quality(TilePlaces.of(quads).corners).aspect_p95 <= LONG


def _first_with_necks(
    tilings: tuple[Tiling, ...], wish: TileWish, grow: Callable[[QuadMesh], Duotone]
) -> Tiling | None:
    """Return the first tiling without a neck narrower than asked, mm, if there is one; a coarser one says so."""
    for tiling in tilings:
        if HOPELESS * typical_side(tiling.quads) < wish.neck:
            continue
        if coarse_necks(grow(tiling.quads), rings=wish.rings, depth=wish.depth).min() >= wish.neck:
            note = f"tiles are larger: the cells are uneven, and the narrowest neck has to be {wish.neck:.3g} mm wide"
            return tiling if tiling is tilings[0] else replace(tiling, notes=(note, *tiling.notes))
    return None
