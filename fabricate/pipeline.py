"""The straight line: from a config to a folder of verified files, and from files back to a report."""

from __future__ import annotations

import platform
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import perf_counter

from fabricate.arrays import Floats
from fabricate.checks.facts import WireFacts
from fabricate.checks.finished import finish_facts, with_finish
from fabricate.checks.judge import judged_parts, read_part
from fabricate.checks.judged_wire import judged_wire
from fabricate.checks.measured import chords, expectations, mesh_facts, pattern_facts
from fabricate.checks.recheck import rechecked
from fabricate.checks.report import Check, Report, report_json
from fabricate.checks.share import share_checks
from fabricate.checks.shop import most_polygons
from fabricate.config import (
    Config,
    FileConfig,
    PatternConfig,
    SphereConfig,
    ThicknessConfig,
    config_sha256,
    moved_config,
    resolved_toml,
)
from fabricate.config.handles_config import handles_of_yellow
from fabricate.design.area_share import shared_cut, square_arc
from fabricate.design.curve_wish import CurveWish
from fabricate.design.designed import designed, grown
from fabricate.design.field import FieldWish
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.handles import checked_handles
from fabricate.errors import MeshError
from fabricate.formats.field_source import field_source
from fabricate.formats.limits import ReadLimits
from fabricate.formats.reading import read_mesh
from fabricate.formats.source import source_mesh
from fabricate.mesh.closed import genus
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.output.curve_svg import write_curve_svg
from fabricate.output.files import write_whole
from fabricate.output.folder import checked_place, complete_folder
from fabricate.output.sculpture import write_parts, write_pictures
from fabricate.output.stl import write_stl
from fabricate.picture.line_drawing import line_drawing
from fabricate.picture.witness_marks import witness_marks
from fabricate.prepare.density import check_room, finest_tile
from fabricate.prepare.inspection import Inspection, inspected
from fabricate.prepare.prepared import Prepared, prepared
from fabricate.prepare.store import NOTHING_KEPT, Store
from fabricate.process import PROCESSES, Process
from fabricate.solid.detailed import detailed_cut
from fabricate.solid.finish import FinishWish, finished
from fabricate.solid.polygon_budget import affordable
from fabricate.solid.settling import fitted_cut, has_room
from fabricate.solid.solids import solids
from fabricate.solid.spacing import spaced
from fabricate.solid.thickness import varying_thickness
from fabricate.solid.wire import Wire, wire
from fabricate.surface.cut import CutSurface
from fabricate.surface.cut_certificate import cut_certificate
from fabricate.surface.tile_choice import TileWish, chosen_tiling, tile_scale
from fabricate.surface.tiling import Tiling
from fabricate.versions import installed_version

LIBRARIES = ("fabricate", "numpy", "scipy", "manifold3d", "libigl", "embreex", "lib3mf", "pymeshlab", "pyquadriflow")

NECK_MARGIN = 1.05
"""How much wider necks are asked for than the process needs: on the finished surface they may be a little narrower."""


def run(
    config: Config, *, name: str, out: Path, progress: Callable[[str], None], store: Store = NOTHING_KEPT
) -> tuple[Report, ...]:
    """Make the sculpture of a config in the folder `out / name`, and return what was proved of it.

    With `prepare.components = "each"` every body is a sculpture of its own, in `out / name-1` and so on.
    `progress` is called with each stage's name as it begins. Wraps and new cells are taken from the `store` if
    they were made before from the same.

    Raises
    ------
    FabricateError
        If the config, the mesh or the place to write is wrong; then nothing is written, or, with several
        bodies, nothing of the one that it is about.
    """
    checked_place(out / name)
    watch = _Stopwatch(progress)
    watch.begin("read")
    prepare = config.prepare
    limits = ReadLimits(max_bytes=prepare.max_file_mb << 20, max_faces=prepare.max_faces)
    mesh = source_mesh(config.source, limits=limits)
    field = _field(config, limits)
    watch.begin("prepare")
    bodies = _bodies(mesh, config, store)
    if prepare.components != "each":
        return (_sculpture(bodies[0], config, field, name=name, out=out, watch=watch, store=store),)
    return tuple(
        _sculpture(body, config, field, name=f"{name}-{number}", out=out, watch=watch.copy(), store=store)
        for number, body in enumerate(bodies, start=1)
    )


def _bodies(mesh: PolygonMesh, config: Config, store: Store) -> tuple[Prepared, ...]:
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


def _sculpture(
    body: Prepared,
    config: Config,
    field: FieldWish | None,
    *,
    name: str,
    out: Path,
    watch: _Stopwatch,
    store: Store,
) -> Report:
    """Make the parts of one body."""
    solid, process = config.solid, PROCESSES[config.process.name]
    watch.begin("quads")
    wish, limit = _wish(config, body)
    curve = _curve_wish(config, field, genus=genus(body.mesh), neck=wish.neck)
    own = _in_place(curve, body, wish)
    tiling = chosen_tiling(body.mesh, wish, grow=partial(grown, wish=own), progress=watch.tell, store=store)
    watch.begin("duotone")
    design = designed(tiling.quads, _in_place(curve, body, wish, tiling), progress=watch.tell)
    duotone = design.duotone
    watch.begin("cut")
    fitting = affordable(
        partial(_surface, duotone, tiling, config),
        tolerance=solid.tolerance,
        core=solid.core,
        budget=None if config.process.shop is None else most_polygons(config.process.shop),
    )
    surface, coarser = fitting.surface, fitting.tolerance > solid.tolerance
    certificate = cut_certificate(surface)
    watch.begin("solids")
    made = solids(surface, thickness=_thickness(surface, config), clearance=solid.clearance, core=solid.core)
    ready = finished(surface, made, _finish_wish(config))
    bent = _wire(surface, config)
    with complete_folder(out / name) as folder:
        watch.begin("files")
        paths = write_parts(folder, ready.parts, list(surface.points[surface.curves]), name=name)
        _write_curve_files(folder, surface, bent, config, name=name)
        write_whole(folder / "config.toml", resolved_toml(moved_config(config, out / name)).encode())
        watch.begin("checks")
        wanted = expectations(
            surface,
            made,
            certificate,
            clearance=solid.clearance,
            core=solid.core,
            process=process,
            shop=config.process.shop,
        )
        judged = judged_parts([read_part(path) for path in paths], with_finish(wanted, ready))
        pattern = pattern_facts(design, certificate, surface)
        thread, alone = _judged_wire(folder, bent, process)
        watch.begin("pictures")
        write_pictures(folder, ready.parts, marks=witness_marks(ready.parts, judged.fit.pairs if judged.fit else {}))
        report = Report(
            name=name,
            config_sha256=config_sha256(config),
            versions=_versions(),
            mesh=mesh_facts(
                body,
                replace(tiling, notes=limit + tiling.notes),
                surface,
                chords(duotone, surface, asked=solid.tolerance) if coarser else None,
            ),
            pattern=pattern,
            parts=judged.parts,
            fit=judged.fit,
            checks=judged.checks + alone + share_checks(config.pattern.area_share, found=pattern.area_share["yellow"]),
            seconds=watch.ended(),
            wire=thread,
            finish=finish_facts(ready),
        )
        write_whole(folder / "report.json", report_json(report).encode())
    return report


def inspect(path: Path) -> Inspection:
    """Read a mesh file and say what it is, and what `run` would do about it.

    Raises
    ------
    ReadError
        If the file is missing, damaged or no mesh.
    """
    return inspected(read_mesh(path))


def check(paths: Sequence[Path], *, clearance: float | None) -> Report:
    """Read parts back from a folder that `run` made, or from STL files, and judge them.

    Raises
    ------
    ReadError
        If a file is missing or damaged.
    """
    name, sha256, judged, thread = rechecked(paths, clearance=clearance)
    return Report(
        name=name,
        config_sha256=sha256,
        versions=_versions(),
        mesh=None,
        pattern=None,
        parts=judged.parts,
        fit=judged.fit,
        checks=judged.checks,
        wire=thread,
    )


def _wish(config: Config, body: Prepared) -> tuple[TileWish, tuple[str, ...]]:
    """Return what is asked of a body's tiles, and the sentence that says what bound their size, if it is free."""
    source, pattern, prepare = config.source, config.pattern, config.prepare
    process, clearance = PROCESSES[config.process.name], config.solid.clearance
    feature = process.feature_min
    wish = TileWish(
        size=source.size,
        tile_size=None if pattern.tile_size == "auto" else pattern.tile_size,
        levels=pattern.levels,
        cells="quads" if prepare.cells == "auto" and body.wrapped else prepare.cells,
        neck=NECK_MARGIN * (feature + clearance),
        clearance=clearance,
        thinnest=2.0 * process.wall_min + clearance,
        resized=pattern.tile_size == "auto",
        rings=_expected_rings(pattern),
        seed=prepare.seed,
        cage=not isinstance(source, FileConfig),
        round_limit=isinstance(source, SphereConfig),
    )
    if isinstance(pattern.tile_size, float):
        check_room(pattern.positions, tile_size=pattern.tile_size, clearance=clearance)
    if pattern.tile_size != "auto":
        return wish, ()
    finest = finest_tile(feature, clearance, extent=source.size, rings=_expected_rings(pattern))
    return replace(wish, tile_size=finest.tile_size), (finest.limit,)


def _curve_wish(config: Config, field: FieldWish | None, *, genus: int, neck: float) -> CurveWish:
    pattern = config.pattern
    return CurveWish(
        tree=pattern.tree,
        seed=pattern.seed,
        root=pattern.root,
        rings=_expected_rings(pattern),
        neck=neck,
        field=field,
        locks=pattern.locks or (),
        handles=checked_handles(handles_of_yellow(pattern.handles, genus), genus),
        optimise=config.optimise,
    )


def _in_place(curve: CurveWish, body: Prepared, wish: TileWish, tiling: Tiling | None = None) -> CurveWish:
    """Return the wish with values of a body's mesh, if it has any, where its tiling is, or one of its own cells."""
    if curve.field is None or not curve.field.of_mesh:
        return curve
    return replace(curve, field=curve.field.scaled(tile_scale(body.mesh, wish, tiling)))


def _expected_rings(pattern: PatternConfig) -> tuple[float, ...]:
    """Return the rings, or about where the one will be for the area share: tiles and tree are chosen for them."""
    return pattern.positions if pattern.area_share is None else (square_arc(pattern.area_share),)


def _surface(duotone: Duotone, tiling: Tiling, config: Config, tolerance: float) -> CutSurface:
    """Return the cut surface, by a tolerance, mm, with the rings asked for or the one that the area share needs."""
    make, share = partial(_cut, duotone, tiling, config, tolerance), config.pattern.area_share
    clearance = config.solid.clearance
    if share is None:
        return spaced(make(config.pattern.positions), clearance=clearance)
    shared = shared_cut(duotone, share=share, make=make, fits=partial(has_room, clearance=clearance))
    return spaced(shared, clearance=clearance)


def _cut(duotone: Duotone, tiling: Tiling, config: Config, tolerance: float, rings: tuple[float, ...]) -> CutSurface:
    """Return the cut surface, with the detail of the input where new cells were made for it."""
    clearance = config.solid.clearance
    if tiling.surface is None or config.prepare.detail == "smooth":
        return fitted_cut(duotone, rings=rings, tolerance=tolerance, clearance=clearance)
    return detailed_cut(duotone, tiling.surface, rings=rings, tolerance=tolerance, clearance=clearance)


def _wire(surface: CutSurface, config: Config) -> Wire | None:
    """Return the wire along the curve, if one is asked for."""
    if config.curve.wire is None:
        return None
    return wire(surface.points[surface.curves[0]], diameter=config.curve.wire, tolerance=config.solid.tolerance)


def _write_curve_files(folder: Path, surface: CutSurface, bent: Wire | None, config: Config, *, name: str) -> None:
    """Write the wire, and the drawings of the curve, that are asked for."""
    if bent is not None:
        write_stl(folder / f"{bent.part.name}.stl", bent.part)
    curves, normals = surface.points[surface.curves], surface.normals[surface.curves]
    for view in config.curve.views:
        drawing = line_drawing(curves, normals, surface.points, surface.triangles, view)
        lighter = config.curve.hidden == "lighter"
        write_curve_svg(folder / f"curve-{view}.svg", drawing, title=name, with_hidden=lighter)


def _judged_wire(folder: Path, bent: Wire | None, process: Process) -> tuple[WireFacts | None, tuple[Check, ...]]:
    """Return the facts and checks of the wire's file, if there is one."""
    if bent is None:
        return None, ()
    path = folder / f"{bent.part.name}.stl"
    return judged_wire(path, diameter=bent.diameter, length=bent.length, process=process)


def _thickness(surface: CutSurface, config: Config) -> float | Floats:
    """Return the thickness of the walls, the same everywhere or one for each point of the surface; mm."""
    wish = config.solid.thickness
    if not isinstance(wish, ThicknessConfig):
        return wish
    return varying_thickness(surface, thinnest=wish.min, thickest=wish.max, by=wish.by)


def _finish_wish(config: Config) -> FinishWish:
    solid, openings, base = config.solid, config.solid.openings, config.solid.base
    return FinishWish(
        clearance=solid.clearance,
        wall=PROCESSES[config.process.name].wall_min,
        tolerance=solid.tolerance,
        opening_diameter=0.0 if openings is None else openings.diameter,
        opening_count=0 if openings is None else openings.count,
        stand_height=0.0 if base is None else base.height,
    )


def _versions() -> dict[str, str]:
    return {"python": platform.python_version(), **{name: installed_version(name) for name in LIBRARIES}}


class _Stopwatch:
    """Tells of each stage as it begins, and how long each one took."""

    def __init__(self, progress: Callable[[str], None]) -> None:
        self._progress = progress
        self._began: list[tuple[str, float]] = []

    def begin(self, stage: str) -> None:
        self._began.append((stage, perf_counter()))
        self._progress(stage)

    def tell(self, step: str) -> None:
        """Tell of a step within a stage."""
        self._progress(step)

    def copy(self) -> _Stopwatch:
        """Return another watch that has run as long."""
        other = _Stopwatch(self._progress)
        other._began = list(self._began)
        return other

    def ended(self) -> dict[str, float]:
        """Return the seconds of every stage, the last one ending now."""
        ends = [time for _, time in self._began[1:]] + [perf_counter()]
        return {stage: end - start for (stage, start), end in zip(self._began, ends, strict=True)}
