"""Judging the wire along the curve, as its file holds it."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from fabricate.checks.check import Check
from fabricate.checks.expectations import Expectations
from fabricate.checks.facts import WireFacts
from fabricate.checks.judge import judged_alone, read_part
from fabricate.process import Process

GENUS = 1
"""Handles of a closed tube."""


class JudgedWire(NamedTuple):
    """Facts and checks of the wire."""

    facts: WireFacts
    checks: tuple[Check, ...]


def judged_wire(path: Path, *, diameter: float, length: float, process: Process) -> JudgedWire:
    """Read a wire of this diameter and length, mm, back from its file, and judge it by itself.

    Raises
    ------
    ReadError
        If the file is missing or damaged.
    """
    part = read_part(path)
    facts, checks = judged_alone(part, Expectations(genus={part.name: GENUS}, process=process))
    return JudgedWire(WireFacts(**vars(facts), diameter_mm=diameter, length_mm=length), checks)
