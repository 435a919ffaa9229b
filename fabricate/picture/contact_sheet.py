"""Contact sheets: the pictures of many sculptures on one, each over its name, to choose from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from fabricate.picture.render import BACKGROUND

COLUMN, CAPTION, LETTERS = 600, 40, 22
"""Width of a picture, height of what is written under it, and size of the letters, in pixels."""

MOST_COLUMNS, SQUARENESS = 6, 0.7
"""With so many columns a sheet grows downwards; up to then it has about so many rows for each column's worth."""

EMPTY = 120
"""Height of a row none of whose sculptures has a picture, in pixels."""

INK, WARNING = (0x33, 0x33, 0x33), (0xB0, 0x2A, 0x1E)


@dataclass(frozen=True)
class Entry:
    """One sculpture on the sheet.

    Attributes
    ----------
    name : str
    picture : Path or None
        Its picture, a PNG file; None where it was not made.
    fault : str
        What is wrong with it, in a few words; empty if nothing is.
    """

    name: str
    picture: Path | None
    fault: str = ""


def contact_sheet(entries: Sequence[Entry]) -> Image.Image:
    """Return the pictures in rows, in the order given, each over its name and what is wrong with it.

    Raises
    ------
    ValueError
        If there are no entries.
    """
    if not entries:
        raise ValueError("expected at least one sculpture, found none")
    pictures = [None if entry.picture is None else _reduced(entry.picture) for entry in entries]
    columns = _columns(len(entries))
    rows = range(0, len(entries), columns)
    heights = [_height(pictures[first : first + columns]) + CAPTION for first in rows]
    sheet = Image.new("RGB", (columns * COLUMN, sum(heights)), _paper())
    for first, top, height in zip(rows, accumulate(heights, initial=0), heights, strict=False):
        for column, place in enumerate(range(first, min(first + columns, len(entries)))):
            _paste(sheet, entries[place], pictures[place], left=column * COLUMN, bottom=top + height)
    return sheet


def _columns(count: int) -> int:
    return int(np.clip(np.ceil(np.sqrt(SQUARENESS * count)), min(count, 2), MOST_COLUMNS))


def _paper() -> tuple[int, int, int]:
    red, green, blue = (round(255 * part) for part in BACKGROUND)
    return red, green, blue


def _reduced(path: Path) -> Image.Image:
    with Image.open(path) as image:
        height = max(round(image.height * COLUMN / image.width), 1)
        return image.convert("RGB").resize((COLUMN, height), Image.Resampling.LANCZOS)


def _height(pictures: Sequence[Image.Image | None]) -> int:
    return max((picture.height for picture in pictures if picture is not None), default=EMPTY)


def _paste(sheet: Image.Image, entry: Entry, picture: Image.Image | None, *, left: int, bottom: int) -> None:
    """Put a picture on the line above its caption, and write the caption."""
    if picture is not None:
        sheet.paste(picture, (left, bottom - CAPTION - picture.height))
    font = ImageFont.load_default(size=LETTERS)
    words = f"{entry.name}: {entry.fault}" if entry.fault else entry.name
    while font.getlength(words) > 0.95 * COLUMN:
        words = words.rstrip("…")[:-1] + "…"
    place = (left + COLUMN // 2, bottom - CAPTION // 2)
    ImageDraw.Draw(sheet).text(place, words, fill=WARNING if entry.fault else INK, font=font, anchor="mm")
