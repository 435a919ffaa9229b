"""The report: all facts and all checks of one run, and its form in report.json."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from types import MappingProxyType
from typing import Any

import numpy as np

from fabricate.checks.check import Check
from fabricate.checks.facts import FinishFacts, FitFacts, JointFacts, MeshFacts, PartFacts, PatternFacts, WireFacts

__all__ = ["Check", "Report", "report_json"]

DIGITS = 6
"""Significant digits of the numbers in report.json; float32 coordinates hold seven."""


@dataclass(frozen=True, eq=False)
class Report:
    """What is known of a finished set of parts.

    Attributes
    ----------
    name : str
        The sculpture's, that is the stem of its config or folder.
    config_sha256 : str
        Of the resolved config; empty when there was none.
    versions : mapping of str to str
        Version of each program that took part.
    mesh, pattern, fit
        Facts, or None when there was nothing to measure, as for STL files without a config.
    parts : mapping of str to PartFacts
        By the parts' names.
    checks : tuple of Check
        Every check, in the order of judging.
    seconds : mapping of str to float
        Time that each stage took.
    wire : WireFacts or None
        The wire along the curve, where one was asked for.
    finish : FinishFacts or None
        Openings and stand; None where nothing is known of them.
    joint : JointFacts or None
        How facing walls run; None where nothing is known of that.
    """

    name: str
    config_sha256: str
    versions: Mapping[str, str]
    mesh: MeshFacts | None
    pattern: PatternFacts | None
    parts: Mapping[str, PartFacts]
    fit: FitFacts | None
    checks: tuple[Check, ...]
    seconds: Mapping[str, float] = field(default_factory=dict)
    wire: WireFacts | None = None
    finish: FinishFacts | None = None
    joint: JointFacts | None = None

    def __post_init__(self) -> None:
        for name in ("versions", "parts", "seconds"):
            object.__setattr__(self, name, MappingProxyType(dict(getattr(self, name))))

    @property
    def ok(self) -> bool:
        """True when at least one check ran and none failed."""
        return any(check.ok for check in self.checks) and not any(check.failed for check in self.checks)

    @property
    def notes(self) -> tuple[str, ...]:
        """What a user should know of the mesh, its tiles, the curve and the finish, in sentences."""
        of_mesh = () if self.mesh is None else self.mesh.notes
        of_pattern = () if self.pattern is None else self.pattern.tile_quality.warnings + self.pattern.notes
        return of_mesh + of_pattern + (() if self.finish is None else self.finish.notes)


def report_json(report: Report) -> str:
    """Return the report as JSON text: keys in the order of the contract, six digits, a newline at the end.

    Numbers that JSON has no word for, NaN and the infinities, become null.
    """
    content = {
        "name": report.name,
        "ok": report.ok,
        "config_sha256": report.config_sha256,
        "versions": report.versions,
        "mesh": report.mesh,
        "pattern": report.pattern,
        "parts": report.parts,
        "finish": report.finish,
        "joint": report.joint,
        "fit": report.fit,
        "wire": report.wire,
        "checks": report.checks,
        "seconds": report.seconds,
    }
    return json.dumps(json_value(content), indent=2, allow_nan=False, ensure_ascii=False) + "\n"


def json_value(value: Any) -> Any:
    """Return a value in dicts, lists and numbers that JSON can hold; numbers with six significant digits."""
    if isinstance(value, Check):
        return {name: json_value(getattr(value, name)) for name in ("code", "ok", "skipped", "message", "where")}
    if is_dataclass(value):
        return {each.name: json_value(getattr(value, each.name)) for each in fields(value)}
    if isinstance(value, Mapping):
        return {key: json_value(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return json_value(value.tolist())
    if isinstance(value, list | tuple):
        return [json_value(item) for item in value]
    return _rounded(value) if isinstance(value, float) else value


def _rounded(number: float) -> float | None:
    return float(f"{number:.{DIGITS}g}") if math.isfinite(number) else None
