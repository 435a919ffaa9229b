"""What a config asks of each stage, in that stage's own terms."""

from __future__ import annotations

from dataclasses import replace

from fabricate.arrays import Floats
from fabricate.config import Config, FileConfig, PatternConfig, SphereConfig, ThicknessConfig
from fabricate.config.handles_config import handles_of_yellow
from fabricate.design.area_share import square_arc
from fabricate.design.curve_wish import CurveWish
from fabricate.design.field import FieldWish
from fabricate.duotone.handles import checked_handles
from fabricate.prepare.density import check_room, finest_tile
from fabricate.prepare.prepared import Prepared
from fabricate.process import PROCESSES
from fabricate.solid.finish import FinishWish
from fabricate.solid.joint import Joint
from fabricate.solid.neck_depth import thickness_for_necks
from fabricate.solid.thickness import varying_thickness
from fabricate.surface.cut import CutSurface
from fabricate.surface.tile_choice import TileWish, tile_scale
from fabricate.surface.tiling import Tiling

NECK_MARGIN = 1.08
"""How much wider necks are asked for than the process needs: on the finished surface they may be a little narrower, and
gaps between walls that lean or twist are up to a fifth wider than the clearance."""

LEAST_WALL = 1.25
"""Least thickness that walls keep where they are made shallower for the sake of necks, in the process's thinnest."""


def tile_wish(config: Config, body: Prepared) -> tuple[TileWish, tuple[str, ...]]:
    """Return what is asked of a body's tiles, and the sentence that says what bound their size, if it is free."""
    source, pattern, prepare = config.source, config.pattern, config.prepare
    process, clearance = PROCESSES[config.process.name], config.solid.clearance
    feature = process.feature_min
    wish = TileWish(
        size=source.size,
        tile_size=None if pattern.tile_size == "auto" else pattern.tile_size,
        levels=pattern.levels,
        cells="quads" if prepare.cells == "auto" and body.wrapped else prepare.cells,
        neck=neck_wish(config),
        depth=config.solid.thickness_range[1],
        clearance=clearance,
        thinnest=2.0 * process.wall_min + clearance,
        resized=pattern.tile_size == "auto",
        rings=expected_rings(pattern),
        seed=prepare.seed,
        crease=prepare.crease,
        cage=not isinstance(source, FileConfig),
        round_limit=isinstance(source, SphereConfig),
    )
    if isinstance(pattern.tile_size, float):
        check_room(pattern.positions, tile_size=pattern.tile_size, clearance=clearance)
    if pattern.tile_size != "auto":
        return wish, ()
    finest = finest_tile(feature, clearance, extent=source.size, rings=expected_rings(pattern))
    return replace(wish, tile_size=finest.tile_size), (finest.limit,)


def neck_wish(config: Config) -> float:
    """Return how wide necks should be before clearance is taken off, mm."""
    return NECK_MARGIN * (PROCESSES[config.process.name].feature_min + config.solid.clearance)


def curve_wish(config: Config, field: FieldWish | None, *, genus: int, neck: float, depth: float) -> CurveWish:
    """Return what is asked of the curve on a body of a genus, with necks of so many mm at that depth, mm."""
    pattern = config.pattern
    return CurveWish(
        tree=pattern.tree,
        seed=pattern.seed,
        root=pattern.root,
        rings=expected_rings(pattern),
        neck=neck,
        depth=depth,
        field=field,
        locks=pattern.locks or (),
        handles=checked_handles(handles_of_yellow(pattern.handles, genus), genus),
        optimise=config.optimise,
    )


def in_place(curve: CurveWish, body: Prepared, wish: TileWish, tiling: Tiling | None = None) -> CurveWish:
    """Return the wish with values of a body's mesh, if it has any, where its tiling is, or one of its own cells."""
    if curve.field is None or not curve.field.of_mesh:
        return curve
    return replace(curve, field=curve.field.scaled(tile_scale(body.mesh, wish, tiling)))


def expected_rings(pattern: PatternConfig) -> tuple[float, ...]:
    """Return the rings, or about where the one will be for the area share: tiles and tree are chosen for them."""
    return pattern.positions if pattern.area_share is None else (square_arc(pattern.area_share),)


def wall_thickness(surface: CutSurface, config: Config) -> float | Floats:
    """Return the thickness of the walls, the same everywhere or one for each point of the surface; mm."""
    wish, process = config.solid.thickness, PROCESSES[config.process.name]
    asked: float | Floats = (
        varying_thickness(surface, thinnest=wish.min, thickest=wish.max, by=wish.by)
        if isinstance(wish, ThicknessConfig)
        else wish
    )
    return thickness_for_necks(surface, asked, neck=neck_wish(config), least=LEAST_WALL * process.wall_min)


def joint_wish(config: Config) -> Joint:
    """Return the joint that a config asks for, with what it leaves to what fits left open."""
    solid = config.solid
    asked = (solid.draft, solid.tongue.height, solid.tongue.width)
    angle, height, width = (None if size == "auto" else size for size in asked)
    neck = PROCESSES[config.process.name].feature_min
    return Joint(kind=solid.joint, angle=angle, height=height, width=width, neck=neck)


def finish_wish(config: Config) -> FinishWish:
    """Return the openings and the stand that a config asks for."""
    solid, openings, base = config.solid, config.solid.openings, config.solid.base
    return FinishWish(
        clearance=solid.clearance,
        wall=PROCESSES[config.process.name].wall_min,
        tolerance=solid.tolerance,
        opening_diameter=0.0 if openings is None else openings.diameter,
        opening_count=0 if openings is None else openings.count,
        stand_height=0.0 if base is None else base.height,
    )
