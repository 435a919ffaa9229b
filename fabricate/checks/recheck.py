"""Judging what lies on disk: a folder that a run has made, or any STL files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from fabricate.checks.check import Check
from fabricate.checks.expectations import Expectations
from fabricate.checks.facts import WireFacts
from fabricate.checks.judge import Judgement, judged_parts, read_part
from fabricate.checks.judged_wire import judged_wire
from fabricate.checks.recorded import (
    RecordedWire,
    as_recorded,
    read_middles,
    read_report,
    recorded_checks,
    recorded_expectations,
)
from fabricate.config import load_config
from fabricate.errors import ReadError
from fabricate.process import PROCESSES, Process

VOLUME_MOVED = 1e-4
"""A volume that differs by more than this share from the one in the report has moved."""


class Recheck(NamedTuple):
    """What was judged, its name, the hash of its config if it has one, the outcome, and the wire's if there is one."""

    name: str
    config_sha256: str
    judgement: Judgement
    wire: WireFacts | None = None


def rechecked(paths: Sequence[Path], *, clearance: float | None) -> Recheck:
    """Read parts back and judge them; one folder made by `run`, or one or more STL files.

    In a folder, report.json, config.toml and curve.ply say what the parts should be, and volumes are compared with
    those in the report. Between bare files only what files can tell is judged; the rest is skipped.

    Raises
    ------
    ReadError
        If a file is missing or damaged, or folders and files are mixed.
    """
    folders = [path for path in paths if path.is_dir()]
    if not folders:
        parts = [read_part(path) for path in paths]
        name = "+".join(part.name for part in parts)
        return Recheck(name, "", judged_parts(parts, Expectations(clearance=clearance)))
    if len(paths) > 1:
        raise ReadError(f"one folder or several STL files were expected, found {len(paths)} paths with a folder")
    return _rechecked_folder(folders[0], clearance)


def _rechecked_folder(folder: Path, clearance: float | None) -> Recheck:
    recorded = read_report(folder / "report.json")
    if not (folder / "config.toml").is_file():
        raise ReadError(f"{folder / 'config.toml'}: not found; `fabricate run` wrote it beside the parts: put it back")
    config = load_config(folder / "config.toml")
    between = config.solid.clearance if clearance is None else clearance
    middles = read_middles(folder / "curve.ply", curves=recorded.pattern.curves)
    parts = [read_part(folder / part.file) for part in recorded.parts.values()]
    judgement = judged_parts(parts, recorded_expectations(recorded, config, clearance=between, middles=middles))
    moved = tuple(
        _volume_moved(name, judgement.parts[name].volume_mm3, part.volume_mm3)
        for name, part in recorded.parts.items()
        if name in judgement.parts
    )
    facts, wired = _rechecked_wire(folder, recorded.wire, PROCESSES[config.process.name])
    designed = recorded_checks(recorded, config, clearance=between)
    return Recheck(
        recorded.name,
        recorded.config_sha256,
        Judgement(judgement.parts, judgement.fit, as_recorded((*judgement.checks, *moved, *wired, *designed))),
        facts,
    )


def _rechecked_wire(
    folder: Path, recorded: RecordedWire | None, process: Process
) -> tuple[WireFacts | None, tuple[Check, ...]]:
    """Return the facts and checks of a folder's wire, if its report has one."""
    if recorded is None:
        return None, ()
    path = folder / recorded.file
    facts, checks = judged_wire(path, diameter=recorded.diameter_mm, length=recorded.length_mm, process=process)
    return facts, (*checks, _volume_moved(path.stem, facts.volume_mm3, recorded.volume_mm3))


def _volume_moved(name: str, found: float, recorded: float) -> Check:
    ok = abs(found - recorded) <= VOLUME_MOVED * abs(recorded)
    verb = "is" if ok else "has moved from"
    message = f"{name}: the volume {found:.2f} mm3 {verb} the {recorded:.2f} mm3 of the report"
    return Check(f"{name}.recorded_volume", ok=ok, message=message)
