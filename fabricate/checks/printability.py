"""Printability: walls, necks, bands and gap of the parts against what a printing process can make.

A gap fails only when slicers close it, which makes one lump of the parts. Between that and the process's own
gap for parts printed in place it passes, and the message says that it is tight.
"""

from __future__ import annotations

import math

import numpy as np

from fabricate.checks.check import Check
from fabricate.checks.expectations import Band, Neck
from fabricate.checks.facts import Narrowest
from fabricate.checks.walls import Walls
from fabricate.checks.wording import place, share_of, told_apart
from fabricate.process import Process
from fabricate.solid.part import Part


def wall_check(part: Part, walls: Walls, *, process: Process | None) -> Check:
    """Check that no wall is thinner than the process can make; points at the thinnest places."""
    code, spread = f"{part.name}.wall", walls.spread
    if spread is None:
        message = f"{part.name} has no opposite faces to measure a wall between"
        return Check(code, ok=False, skipped=True, message=message)
    where = walls.places
    if process is None:
        message = f"the thinnest wall of {part.name} is {spread.min:.4g} mm; no process was named"
        return Check(code, ok=False, skipped=True, message=message, where=where[:1])
    ok = spread.min >= process.wall_min
    rest = "" if ok else f"; {share_of(walls.share_below(process.wall_min))} of the surface is thinner"
    return Check(
        code,
        ok=ok,
        message=f"walls of {part.name} must be at least {process.wall_min:g} mm thick for {process.name}, "
        f"and the thinnest is {told_apart(spread.min, process.wall_min)} mm{rest}",
        where=where[:1] if ok else where[walls.thickness < process.wall_min],
    )


def part_neck_check(name: str, neck: Narrowest | None, *, process: Process | None) -> Check:
    """Check that the narrowest neck of a finished part is at least the process's smallest feature."""
    code = f"{name}.neck"
    if neck is None:
        message = f"{name} has no neck that could be measured between two walls of its joints"
        return Check(code, ok=False, skipped=True, message=message)
    where = np.array([neck.at])
    if process is None:
        message = f"the narrowest neck of {name} is {neck.min:.4g} mm wide; no process was named"
        return Check(code, ok=False, skipped=True, message=message, where=where)
    ok = not neck.min < process.feature_min
    spot = "" if ok else f", at {place(neck.at)}"
    return Check(
        code,
        ok=ok,
        message=f"necks of {name} must be at least {process.feature_min:g} mm wide for {process.name}, "
        f"and the narrowest is {told_apart(neck.min, process.feature_min)} mm{spot}",
        where=where,
    )


def neck_check(neck: Neck | None, *, clearance: float | None, process: Process | None) -> Check:
    """Check that the narrowest neck, less the clearance, is at least the process's smallest feature."""
    code = "pattern.neck"
    if neck is None or clearance is None or process is None:
        missing = "the pattern" if neck is None else "the clearance" if clearance is None else "the process"
        message = f"necks were not judged, because {missing} is not known"
        return Check(code, ok=False, skipped=True, message=message)
    left = neck.width - clearance
    ok = left >= process.feature_min
    advice = "" if ok else f", at {place(neck.at)}; ask for larger tiles"
    return Check(
        code,
        ok=ok,
        message=f"necks must be at least {process.feature_min:g} mm wide for {process.name}, and the narrowest has "
        f"{told_apart(left, process.feature_min)} mm, {neck.width:.4g} mm less the clearance of {clearance:.4g} mm"
        f"{advice}",
        where=np.array([neck.at]),
    )


def band_check(band: Band, *, clearance: float | None, process: Process | None) -> Check:
    """Check that the narrowest band, less the clearance, is at least the process's smallest feature.

    A band is as wide as its rings are apart, so the message says how far apart they would have to be.
    """
    code = "pattern.band"
    if clearance is None or process is None:
        missing = "clearance" if clearance is None else "process"
        message = f"bands were not judged, because the {missing} is not known"
        return Check(code, ok=False, skipped=True, message=message)
    left = band.width - clearance
    ok = left >= process.feature_min
    factor = (process.feature_min + clearance) / max(band.width, 1e-9)
    spacing = math.ceil(1e3 * factor * band.spacing) / 1e3
    advice = (
        ""
        if ok
        else f", at {place(band.at)}; ask for tiles {math.ceil(1e2 * factor) / 1e2:g} times as large, or rings at "
        f"least {spacing:g} apart there instead of {band.spacing:.3g}"
    )
    return Check(
        code,
        ok=ok,
        message=f"bands must be at least {process.feature_min:g} mm wide for {process.name}, and the narrowest, "
        f"{band.name}, has {told_apart(left, process.feature_min)} mm, {band.width:.4g} mm less the clearance of "
        f"{clearance:.4g} mm{advice}",
        where=np.array([band.at]),
    )


def process_gap_check(clearance: float | None, *, process: Process | None) -> Check:
    """Check that slicers keep the gap open; the message says when it is tight for the process.

    Skipped for clearance 0: the parts are one two-colour job.
    """
    code = "fit.process_gap"
    if clearance is None or process is None:
        missing = "clearance" if clearance is None else "process"
        message = f"the gap was not judged for printing, because the {missing} is not known"
        return Check(code, ok=False, skipped=True, message=message)
    if clearance == 0.0:
        message = "there is no gap to keep open: the parts touch on purpose, as one two-colour job"
        return Check(code, ok=False, skipped=True, message=message)
    if process.crack_closed is not None and clearance < process.crack_closed:
        message = (
            f"a clearance of {told_apart(clearance, process.crack_closed)} mm is closed by slicers, which fill gaps "
            f"under {process.crack_closed:g} mm; {process.name} needs {process.captive_gap:g} mm"
        )
        return Check(code, ok=False, message=message)
    return Check(code, ok=True, message=_open_gap(clearance, process))


def _open_gap(clearance: float, process: Process) -> str:
    if clearance >= process.captive_gap:
        return f"a clearance of {clearance:.4g} mm prints loose with {process.name}"
    tight = (
        f"a clearance of {told_apart(clearance, process.captive_gap)} mm is tight for {process.name}, "
        f"which needs {process.captive_gap:g} mm for parts that come out loose"
    )
    if process.tight_gap is not None and clearance >= process.tight_gap:
        return f"{tight}; a well-tuned printer keeps it open"
    return f"{tight}: they may have to be freed by force, or not come free"
