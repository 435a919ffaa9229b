"""The straight line: from a config to a folder of verified files, and from files back to a report."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from fabricate.arrays import Floats
from fabricate.checks.draining import draining_checks, draining_notes
from fabricate.checks.facts import WireFacts
from fabricate.checks.finished import finish_facts
from fabricate.checks.joint_profile import joint_checks, joint_facts
from fabricate.checks.judge import judged_parts, read_part
from fabricate.checks.judged_wire import judged_wire
from fabricate.checks.measured import chords, mesh_facts, pattern_facts
from fabricate.checks.recheck import rechecked
from fabricate.checks.report import Check, Report, report_json
from fabricate.checks.share import share_checks
from fabricate.config import Config, config_sha256, moved_config, resolved_toml
from fabricate.dividing import Body, divided, read_bodies
from fabricate.formats.reading import read_mesh
from fabricate.making import check_fine_enough, made, wanted
from fabricate.output.curve_svg import write_curve_svg
from fabricate.output.files import write_whole
from fabricate.output.folder import checked_place, complete_folder
from fabricate.output.sculpture import write_parts, write_pictures
from fabricate.output.stl import write_stl
from fabricate.picture.line_drawing import line_drawing
from fabricate.picture.witness_marks import witness_marks
from fabricate.prepare.inspection import Inspection, inspected
from fabricate.prepare.store import NOTHING_KEPT, Store
from fabricate.process import PROCESSES, Process
from fabricate.solid.assembly import Assembly
from fabricate.solid.wire import Wire, wire
from fabricate.surface.cut import CutSurface
from fabricate.versions import program_versions


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
    bodies = read_bodies(config, name=name, progress=progress, store=store)
    return tuple(_sculpture(body, config, out=out, store=store) for body in bodies)


def _sculpture(body: Body, config: Config, *, out: Path, store: Store) -> Report:
    """Make the parts of one body."""
    name, watch = body.name, body.watch
    solid, process = config.solid, PROCESSES[config.process.name]
    found = divided(body, config, store=store)
    watch.begin("solids")
    parts = made(found, config)
    (tiling, limit, design, fitting), certificate, own, ready = parts
    duotone, surface, coarser = design.duotone, fitting.surface, fitting.tolerance > solid.tolerance
    bent = _wire(surface, config)
    with complete_folder(out / name) as folder:
        watch.begin("files")
        paths = write_parts(
            folder, ready.parts, list(surface.points[surface.curves]), name=name, middles=_middles(surface, own)
        )
        _write_curve_files(folder, surface, bent, config, name=name)
        write_whole(folder / "config.toml", resolved_toml(moved_config(config, out / name)).encode())
        watch.begin("checks")
        judged = judged_parts([read_part(path) for path in paths], wanted(parts, config))
        check_fine_enough(parts, config, judged.checks)
        pattern = pattern_facts(design, certificate, surface)
        joint, finish = joint_facts(surface, own, solid.joint), finish_facts(ready)
        thread, alone = _judged_wire(folder, bent, process)
        watch.begin("pictures")
        write_pictures(folder, ready.parts, marks=witness_marks(ready.parts, judged.fit.pairs if judged.fit else {}))
        report = Report(
            name=name,
            config_sha256=config_sha256(config),
            versions=program_versions(),
            mesh=mesh_facts(
                body.prepared,
                replace(tiling, notes=limit + tiling.notes),
                surface,
                chords(duotone, surface, asked=solid.tolerance) if coarser else None,
            ),
            pattern=pattern,
            parts=judged.parts,
            fit=judged.fit,
            checks=judged.checks
            + alone
            + joint_checks(joint, clearance=solid.clearance)
            + draining_checks(finish.openings, process=process)
            + share_checks(config.pattern.area_share, found=pattern.area_share["yellow"]),
            seconds=watch.ended(),
            wire=thread,
            finish=replace(finish, notes=draining_notes(finish.openings, core=solid.core, process=process)),
            joint=joint,
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
        versions=program_versions(),
        mesh=None,
        pattern=None,
        parts=judged.parts,
        fit=judged.fit,
        checks=judged.checks,
        wire=thread,
    )


def _middles(surface: CutSurface, made: Assembly) -> list[Floats]:
    """Return places on the mid-line of the joint under each point of each curve, (r, c, 3) mm for each curve."""
    length = surface.curves.shape[1]
    return [made.middles(curve, region).reshape(-1, length, 3) for region, curve in enumerate(surface.curves)]


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
