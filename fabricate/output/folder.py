"""A folder of results that appears only when it is complete."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from fabricate.errors import OutputError
from fabricate.output.files import beside, output_error

MARKER = "report.json"
"""The file that every folder of results has, and that tells it from other folders."""


@contextmanager
def complete_folder(destination: Path) -> Iterator[Path]:
    """Give a hidden folder to write into, and rename it to `destination` when all went well.

    A folder of results that is there already is replaced, with everything in it, and only then: it is moved
    aside, the new one takes its place, the old one is deleted. If the block raises,
    or the new folder can't take its place, the old one stays as it was, and nothing else remains.

    Raises
    ------
    OutputError
        If the place can't be written to, or `destination` is a file or a folder of other things.
    """
    place = checked_place(destination)
    made = [folder for folder in place.parents if not folder.exists()]
    temporary = beside(place, "new")
    try:
        _make(temporary, destination)
        yield temporary
        replaced = _swap_in(temporary, place, destination)
    except BaseException:
        shutil.rmtree(temporary, ignore_errors=True)
        _remove_empty(made)
        raise
    if replaced is not None:
        _delete(replaced, destination)


def checked_place(destination: Path) -> Path:
    """Return the absolute path of a folder to be, links followed, so that renames stay on one disk.

    Raises
    ------
    OutputError
        If `destination` is a file, or a folder that holds other things than results.
    """
    try:
        place = destination.resolve()
        free = bool(place.name) and (place.is_dir() or not place.exists())
        foreign = free and place.is_dir() and any(place.iterdir()) and not (place / MARKER).exists()
    except OSError as reason:
        raise output_error(destination, reason) from reason
    except RuntimeError as reason:  # a ring of links, before Python 3.13
        raise OutputError(f"cannot write {destination}: its links lead in a ring; choose another place") from reason
    if not free:
        what = "a file" if place.name else "a whole disk"
        raise OutputError(f"cannot write the folder {destination}: it is {what}; choose another name")
    if foreign:
        raise OutputError(
            f"cannot replace the folder {destination}: it holds other things than results, for it has no {MARKER}; "
            "choose another name, or empty it"
        )
    return place


def _make(folder: Path, destination: Path) -> None:
    try:
        folder.mkdir(parents=True)
    except OSError as reason:
        raise output_error(destination, reason) from reason


def _swap_in(new: Path, place: Path, destination: Path) -> Path | None:
    """Rename `new` to `place` and return where what was there is now; on failure it is back again."""
    old = beside(place, "old")
    try:
        replacing = place.exists()
        if replacing:
            place.rename(old)
        try:
            new.rename(place)
        except OSError:
            if replacing:
                old.rename(place)
            raise
    except OSError as reason:
        raise output_error(destination, reason) from reason
    return old if replacing else None


def _delete(old: Path, destination: Path) -> None:
    try:
        shutil.rmtree(old)
    except OSError as reason:
        raise OutputError(
            f"{destination} is complete, but the results it replaces could not be deleted: "
            f"{(reason.strerror or str(reason)).lower()}; delete {old} yourself"
        ) from reason


def _remove_empty(folders: list[Path]) -> None:
    """Remove folders that were made on the way, innermost first, unless something lies in them."""
    for folder in folders:
        if not folder.is_dir() or any(folder.iterdir()):
            return
        folder.rmdir()
