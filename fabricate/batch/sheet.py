"""The contact sheet of several runs: OUT/contact-sheet.png."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from fabricate.batch.workers import Outcome
from fabricate.output.png import write_png
from fabricate.picture.contact_sheet import Entry, contact_sheet

NAME = "contact-sheet.png"

FAILED, LOST = "a check failed", "not made"


def write_sheet(outcomes: Sequence[Outcome], out: Path) -> Path | None:
    """Write the pictures of all that was made in the folder `out` on one sheet, in order; return its path.

    What was not made has its name on the sheet. There is none, and nothing is written, where nothing was made.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    entries = [entry for outcome in outcomes for entry in _entries(outcome, out)]
    if all(entry.picture is None for entry in entries):
        return None
    path = out / NAME
    write_png(path, contact_sheet(entries))
    return path


def _entries(outcome: Outcome, out: Path) -> Iterator[Entry]:
    """Return an entry for each folder of a run, or one for the run if it has made none."""
    for name, ok in outcome.made:
        picture = out / name / "preview.png"
        yield Entry(name, picture if picture.is_file() else None, "" if ok else FAILED)
    if not outcome.made:
        yield Entry(outcome.name, None, LOST)
