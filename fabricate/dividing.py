"""The first half of the line: from a config to bodies divided by their curves."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

from fabricate.checks.shop import most_polygons, polygons_wording
from fabricate.config import Config, FileConfig
from fabricate.design.area_share import shared_cut
from fabricate.design.designed import Design, designed, grown
from fabricate.design.field import FieldWish
from fabricate.duotone.duotone import Duotone
from fabricate.errors import MeshError
from fabricate.formats.field_source import field_source
from fabricate.formats.limits import ReadLimits
from fabricate.formats.source import source_mesh
from fabricate.mesh.closed import genus
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.prepared import Prepared, prepared
from fabricate.prepare.store import Store
from fabricate.solid.detailed import detailed_cut
from fabricate.solid.polygon_budget import Affordable, affordable
from fabricate.solid.settling import fitted_cut, has_room
from fabricate.solid.spacing import spaced
from fabricate.solid.thick_enough import check_thick
from fabricate.solid.ways_in import opened
from fabricate.stopwatch import Stopwatch
from fabricate.surface.cut import CutSurface
from fabricate.surface.tile_choice import chosen_tiling, sized_surface
from fabricate.surface.tiling import Tiling
from fabricate.wishes import curve_wish, in_place, tile_wish


class Body(NamedTuple):
    """A body to divide: the name of what is made of it, the field that its curve follows if any, and its stages."""

    name: str
    prepared: Prepared
    field: FieldWish | None
    watch: Stopwatch


def read_bodies(config: Config, *, name: str, progress: Callable[[str], None], store: Store) -> tuple[Body, ...]:
    """Read what a config divides: one body of that name, or with `prepare.components = "each"` name-1 and so on."""
    watch = Stopwatch(progress)
    watch.begin("read")
    prepare = config.prepare
    limits = ReadLimits(max_bytes=prepare.max_file_mb << 20, max_faces=prepare.max_faces)
    mesh = source_mesh(config.source, limits=limits)
    field = _field(config, limits)
    watch.begin("prepare")
    found = _prepared(mesh, config, store)
    watch.stop()
    names = [name] if prepare.components != "each" else [f"{name}-{number}" for number in range(1, len(found) + 1)]
    return tuple(Body(each, body, field, watch.copy()) for each, body in zip(names, found, strict=True))


def _prepared(mesh: PolygonMesh, config: Config, store: Store) -> tuple[Prepared, ...]:
    prepare = config.prepare
    try:
        return prepared(mesh, repair=prepare.repair, components=prepare.components, crease=prepare.crease, store=store)
    except MeshError as error:
        if isinstance(config.source, FileConfig):
            raise MeshError(f"{config.source.file}: {error}") from None
        raise


def _field(config: Config, limits: ReadLimits) -> FieldWish | None:
    if config.field is None:
        return None
    return FieldWish(config.field, field_source(config.field, config.source, limits=limits))


class Divided(NamedTuple):
    """A body divided by its curve: its tiles, what bound their size, the curve, and the cut surface."""

    tiling: Tiling
    limit: tuple[str, ...]
    design: Design
    fitting: Affordable


def divided(named: Body, config: Config, *, store: Store) -> Divided:
    """Divide one body as a config asks: tiles, curve and cut."""
    _, body, field, watch = named
    watch.begin("quads")
    wish, limit = tile_wish(config, body)
    whole = sized_surface(body.mesh, wish)
    check_thick(whole.points, whole.triangles, clearance=config.solid.clearance)
    curve = curve_wish(config, field, genus=genus(body.mesh), neck=wish.neck, depth=wish.depth)
    own = in_place(curve, body, wish)
    tiling = chosen_tiling(body.mesh, wish, grow=partial(grown, wish=own), progress=watch.tell, store=store)
    watch.begin("duotone")
    design = designed(tiling.quads, in_place(curve, body, wish, tiling), progress=watch.tell)
    watch.begin("cut")
    make = partial(_surface, design.duotone, tiling, config)
    fitting = _fitting(make, config, tolerance=config.solid.tolerance, budget=polygon_budget(config))
    return Divided(tiling, limit, design, fitting)


def divided_again(found: Divided, config: Config, *, tolerance: float, budget: int | None) -> Divided:
    """Cut a body again by the same curve: by another tolerance, mm, or for parts with fewer triangles."""
    make = partial(_surface, found.design.duotone, found.tiling, config)
    return found._replace(fitting=_fitting(make, config, tolerance=tolerance, budget=budget))


def polygon_budget(config: Config) -> int | None:
    """Return how many triangles each part may have; None without a limit."""
    return None if config.process.shop is None else most_polygons(config.process.shop)


def _fitting(
    make: Callable[[float], CutSurface], config: Config, *, tolerance: float, budget: int | None
) -> Affordable:
    """Return the surface that keeps a budget; where that is less than the shop's, the finish takes the rest."""
    shop, most = config.process.shop, polygon_budget(config)
    limit = "" if shop is None else polygons_wording(shop)
    if budget is not None and most is not None and budget < most:
        limit += f", of which the stand and openings take {most - budget}"
    return affordable(make, tolerance=tolerance, core=config.solid.core, budget=budget, limit=limit)


def _surface(duotone: Duotone, tiling: Tiling, config: Config, tolerance: float) -> CutSurface:
    """Return the cut surface, by a tolerance, mm, with the rings asked for or the one that the area share needs."""
    make, share = partial(_cut, duotone, tiling, config, tolerance), config.pattern.area_share
    clearance = config.solid.clearance
    if share is None:
        return spaced(opened(make(config.pattern.positions)), clearance=clearance)
    shared = shared_cut(duotone, share=share, make=make, fits=partial(has_room, clearance=clearance))
    return spaced(opened(shared), clearance=clearance)


def _cut(duotone: Duotone, tiling: Tiling, config: Config, tolerance: float, rings: tuple[float, ...]) -> CutSurface:
    """Return the cut surface, with the detail of the input where new cells were made for it."""
    clearance = config.solid.clearance
    if tiling.surface is None or config.prepare.detail == "smooth":
        return fitted_cut(duotone, rings=rings, tolerance=tolerance, clearance=clearance)
    return detailed_cut(duotone, tiling.surface, rings=rings, tolerance=tolerance, clearance=clearance)
