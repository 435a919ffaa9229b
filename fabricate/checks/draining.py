"""Whether resin or powder leaves the hollow inside: what openings the process needs, and which there are."""

from __future__ import annotations

from collections.abc import Sequence

from fabricate.checks.check import Check
from fabricate.checks.facts import OpeningFacts
from fabricate.checks.wording import counted, told_apart
from fabricate.process import Process
from fabricate.solid.assembly import Core


def draining_checks(openings: Sequence[OpeningFacts], *, process: Process) -> tuple[Check, ...]:
    """Check the openings against what the process needs to empty a hollow.

    There is no check of a process that leaves nothing inside, nor where no openings were asked for: see
    `draining_notes`.
    """
    if process.hole_min is None or not openings:
        return ()
    widths = [opening.diameter_mm for opening in openings]
    ok = sum(width >= process.hole_min for width in widths) >= process.holes_min
    advice = "" if ok else f"; {_asked(process)}"
    message = (
        f"a hollow must have at least {_needed(process)} for {process.name}, and there "
        f"{'is' if len(openings) == 1 else 'are'} {len(openings)} of {told_apart(min(widths), process.hole_min)} mm"
        f"{advice}"
    )
    return (Check("finish.openings", ok=ok, message=message),)


def draining_notes(openings: Sequence[OpeningFacts], *, core: Core, process: Process) -> tuple[str, ...]:
    """Return a sentence about a hollow without openings, if the process leaves something in it."""
    if process.hole_min is None or openings or core != "hollow":
        return ()
    needed = f"{process.name} needs at least {_needed(process)} to empty the hollow inside, and there is none"
    return (f"{needed}: {_asked(process)}",)


def _needed(process: Process) -> str:
    return f"{counted(process.holes_min, 'opening')} of {process.hole_min:g} mm"


def _asked(process: Process) -> str:
    return f'ask for solid.openings = {{ diameter = "{process.hole_min:g} mm", count = {process.holes_min} }}'
