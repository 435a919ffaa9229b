"""What a folder that `run` has made records of its parts, beside the parts themselves.

Widths of the pattern, the ridge, the area share and the volumes of gap and shell are facts of the design: they can't be
measured again on finished parts, so they are taken as report.json has them. The joint's mid-line is in curve.ply.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
from pydantic import BaseModel, ValidationError

from fabricate.arrays import Floats
from fabricate.checks.check import Check
from fabricate.checks.draining import draining_checks
from fabricate.checks.expectations import Band, Expectations, Neck
from fabricate.checks.facts import FinishFacts, JointFacts, Spaces, Xyz
from fabricate.checks.finished import with_handles
from fabricate.checks.joint_profile import joint_checks
from fabricate.checks.measured import expected_genus
from fabricate.checks.share import share_checks
from fabricate.config import Config
from fabricate.errors import ReadError
from fabricate.formats.read_ply import read_ply_numbers
from fabricate.process import PROCESSES

AS_RECORDED = {
    "pattern.neck": "widths",
    "pattern.band": "widths",
    "pattern.area_share": "shares",
    "fit.ridge": "heights",
    "finish.openings": "diameters",
    "fit.whole": "volumes of gap and shell",
}
"""Checks that rest on what the report records, and what that is."""


class _Narrowest(BaseModel):
    min: float


class _Pattern(BaseModel):
    curves: int
    handles: dict[str, int]
    area_share: dict[str, float]
    neck_mm: _Narrowest
    band_mm: dict[str, _Narrowest] = {}


class _Chords(BaseModel):
    p99: float


class _Mesh(BaseModel):
    chord_mm: _Chords | None = None


class _Fit(BaseModel):
    spaces_mm3: Spaces | None = None


class _Check(BaseModel):
    code: str
    where: list[Xyz]


class RecordedPart(BaseModel):
    """A part's file and volume."""

    file: str
    volume_mm3: float


class RecordedWire(RecordedPart):
    """The wire's file and what it was made to."""

    diameter_mm: float
    length_mm: float


class Recorded(BaseModel):
    """What is needed of a report.json."""

    name: str
    config_sha256: str
    mesh: _Mesh
    pattern: _Pattern
    parts: dict[str, RecordedPart]
    fit: _Fit
    checks: list[_Check]
    wire: RecordedWire | None = None
    finish: FinishFacts = FinishFacts((), None)
    joint: JointFacts | None = None


def read_report(path: Path) -> Recorded:
    """Read a report.json.

    Raises
    ------
    ReadError
        If it is missing, or no report of `run`; that of a fit coupon is said to be one.
    """
    try:
        content = json.loads(path.read_bytes())
    except OSError:
        raise ReadError(
            f"{path}: not found or not readable; name a folder that `fabricate run` has made, or STL files"
        ) from None
    except ValueError:
        content = None
    if isinstance(content, dict) and "coupon" in content:
        raise ReadError(
            f"{path.parent}: this is the folder of a fit coupon, which was judged as it was made and cannot be judged "
            "again; name a folder that `fabricate run` has made, or STL files"
        )
    try:
        return Recorded.model_validate(content)
    except ValidationError:
        raise ReadError(f"{path}: this is not a report that `fabricate run` has written") from None


def recorded_expectations(recorded: Recorded, config: Config, *, clearance: float, middles: Floats) -> Expectations:
    """Return what parts should be by their report and config; `middles` as `read_middles` returns them."""
    chords = recorded.mesh.chord_mm
    neck = _place(recorded, "pattern.neck")
    names = list(recorded.parts)
    return Expectations(
        clearance=clearance,
        genus=with_handles(expected_genus(recorded.pattern.handles, core=config.solid.core), recorded.finish),
        process=PROCESSES[config.process.name],
        shop=config.process.shop,
        neck=None if neck is None else Neck(recorded.pattern.neck_mm.min, neck),
        band=_band(recorded, config),
        spaces=recorded.fit.spaces_mm3,
        tolerance=config.solid.tolerance if chords is None else chords.p99,
        middles={f"{first}-{second}": own for (first, second), own in zip(pairwise(names), middles, strict=False)},
    )


def recorded_checks(recorded: Recorded, config: Config, *, clearance: float) -> tuple[Check, ...]:
    """Return the checks of ridge, openings and area share, as `run` adds them to those of the parts."""
    ridge = () if recorded.joint is None else joint_checks(recorded.joint, clearance=clearance)
    openings = draining_checks(recorded.finish.openings, process=PROCESSES[config.process.name])
    return ridge + openings + share_checks(config.pattern.area_share, found=recorded.pattern.area_share["yellow"])


def as_recorded(checks: Iterable[Check]) -> tuple[Check, ...]:
    """Return checks, those with the sentence that says so which rest on what the report records."""
    return tuple(
        replace(check, message=f"{check.message} ({AS_RECORDED[check.code]} as recorded in report.json)")
        if check.code in AS_RECORDED and not check.skipped
        else check
        for check in checks
    )


def read_middles(path: Path, *, curves: int) -> Floats:
    """Return places on the mid-line of the joint along each curve of a curve.ply, (curves, k, 3) mm, or (0, 0, 3).

    Raises
    ------
    ReadError
        If the file is missing or damaged.
    """
    try:
        found = read_ply_numbers(path.read_bytes(), prefix="joint")
    except OSError:
        raise ReadError(f"{path}: not found; `fabricate run` wrote it beside the parts: put it back") from None
    except ReadError as error:
        raise ReadError(f"{path}: {error}") from None
    if not found.size:
        return np.zeros((0, 0, 3))
    if found.shape[1] % 3 or curves < 1 or len(found) % curves or not np.isfinite(found).all():
        raise ReadError(f"{path}: places on the mid-line of {curves} curves were expected, found {found.shape} numbers")
    middles: Floats = found.reshape(curves, -1, 3)
    return middles


def _band(recorded: Recorded, config: Config) -> Band | None:
    """Return the narrowest band."""
    at = _place(recorded, "pattern.band")
    widths: Mapping[str, float] = {name: width.min for name, width in recorded.pattern.band_mm.items()}
    spacings = np.diff(config.pattern.positions).tolist()
    if at is None or len(spacings) != len(widths):
        return None
    bands = [Band(name, width, at, spacing) for (name, width), spacing in zip(widths.items(), spacings, strict=True)]
    return min(bands, key=lambda band: band.width, default=None)


def _place(recorded: Recorded, code: str) -> Xyz | None:
    """Return the first place that a check in the report points at."""
    return next((check.where[0] for check in recorded.checks if check.code == code and check.where), None)
