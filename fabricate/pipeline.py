"""The straight line: from a config to a folder of verified files, and from files back to a report."""

from __future__ import annotations

import platform
from collections.abc import Callable, Sequence
from importlib.metadata import version
from pathlib import Path
from time import perf_counter

from fabricate.checks.judge import judged_parts, read_part
from fabricate.checks.measured import expectations, mesh_facts, pattern_facts
from fabricate.checks.recheck import rechecked
from fabricate.checks.report import Report, report_json
from fabricate.config import Config, SphereConfig, config_sha256, resolved_toml
from fabricate.duotone.catmull_clark import catmull_clark, subdivided
from fabricate.duotone.certificate import certified
from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.source import source_mesh
from fabricate.output.files import write_whole
from fabricate.output.folder import checked_place, complete_folder
from fabricate.output.sculpture import write_sculpture
from fabricate.process import PROCESSES
from fabricate.solid.settling import fitted_cut
from fabricate.solid.solids import solids
from fabricate.surface.roundness import polygons, rounded
from fabricate.surface.sizing import sized, tiled

LIBRARIES = ("fabricate", "numpy", "scipy", "manifold3d", "libigl", "embreex", "lib3mf")


def run(config: Config, *, name: str, out: Path, progress: Callable[[str], None]) -> Report:
    """Make the sculpture of a config in the folder `out / name`, and return what was proved of it.

    `progress` is called with each stage's name as it begins.

    Raises
    ------
    FabricateError
        If the config, the mesh or the place to write is wrong; then nothing is written.
    """
    checked_place(out / name)
    watch = _Stopwatch(progress)
    pattern, solid = config.pattern, config.solid

    watch.begin("read")
    mesh = source_mesh(config.source)
    watch.begin("quads")
    quads = _quads(mesh, config)
    watch.begin("duotone")
    duotone = grown_duotone(quads, tree=pattern.tree, seed=pattern.seed)
    certificate = certified(duotone)
    watch.begin("cut")
    surface = fitted_cut(duotone, arc=pattern.arc, tolerance=solid.tolerance, clearance=solid.clearance)
    watch.begin("solids")
    made = solids(surface, thickness=solid.thickness, clearance=solid.clearance, core=solid.core)
    with complete_folder(out / name) as folder:
        watch.begin("files")
        paths = write_sculpture(folder, made.parts, surface.points[surface.curve], name=name)
        write_whole(folder / "config.toml", resolved_toml(config).encode())
        watch.begin("checks")
        wanted = expectations(
            surface,
            made,
            certificate,
            clearance=solid.clearance,
            core=solid.core,
            process=PROCESSES[config.process.name],
        )
        judged = judged_parts([read_part(path) for path in paths], wanted)
        report = Report(
            name=name,
            config_sha256=config_sha256(config),
            versions=_versions(),
            mesh=mesh_facts(mesh, surface),
            pattern=pattern_facts(duotone, certificate, surface),
            parts=judged.parts,
            fit=judged.fit,
            checks=judged.checks,
            seconds=watch.ended(),
        )
        write_whole(folder / "report.json", report_json(report).encode())
    return report


def check(paths: Sequence[Path], *, clearance: float | None) -> Report:
    """Read parts back from a folder that `run` made, or from STL files, and judge them.

    Raises
    ------
    ReadError
        If a file is missing or damaged.
    """
    name, sha256, judged = rechecked(paths, clearance=clearance)
    return Report(
        name=name,
        config_sha256=sha256,
        versions=_versions(),
        mesh=None,
        pattern=None,
        parts=judged.parts,
        fit=judged.fit,
        checks=judged.checks,
    )


def _quads(mesh: PolygonMesh, config: Config) -> QuadMesh:
    """Return the sized quads of a mesh; of a sphere, moved after the first step so that its limit is round."""
    levels = config.pattern.levels
    steps = levels or 0
    if isinstance(config.source, SphereConfig) and levels != 0:
        mesh = polygons(rounded(catmull_clark(mesh).mesh))
        steps -= 1
    mesh = sized(mesh, size=config.source.size)
    if config.pattern.tile_size is not None:
        return tiled(mesh, tile_size=config.pattern.tile_size)
    return subdivided(mesh, levels=steps) if steps else two_coloured(mesh)


def _versions() -> dict[str, str]:
    return {"python": platform.python_version(), **{name: version(name) for name in LIBRARIES}}


class _Stopwatch:
    """Tells of each stage as it begins, and how long each one took."""

    def __init__(self, progress: Callable[[str], None]) -> None:
        self._progress = progress
        self._began: list[tuple[str, float]] = []

    def begin(self, stage: str) -> None:
        self._began.append((stage, perf_counter()))
        self._progress(stage)

    def ended(self) -> dict[str, float]:
        """Return the seconds of every stage, the last one ending now."""
        ends = [time for _, time in self._began[1:]] + [perf_counter()]
        return {stage: end - start for (stage, start), end in zip(self._began, ends, strict=True)}
