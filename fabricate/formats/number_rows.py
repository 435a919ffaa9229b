"""The rows of numbers that text formats consist of, read with the line that each stands on."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits

_BLANK = np.isin(np.arange(256), np.frombuffer(b" \t\n\r\v\f", dtype=np.uint8))
_GAP = re.compile(rb"[ \t\n\r\v\f]")
_BLOCK_BYTES = 1 << 20
"""Words take twenty times the memory of the text that they are in: so much text is split at once."""


@dataclass(frozen=True, eq=False)
class NumberRows:
    """The numbers in a text, line by line; lines without any are left out.

    Attributes
    ----------
    values : (n,) float
        All numbers, row after row.
    offsets : (r + 1,) int
        Where each row begins in `values`, and where the last one ends.
    lines : (r,) int
        The number of the line that each row stands on.
    """

    values: Floats
    offsets: Indices
    lines: Indices

    @property
    def sizes(self) -> Indices:
        """(r,) int: how many numbers each row has."""
        return np.diff(self.offsets)


def number_rows(text: bytes, *, first_line: int = 1, limits: ReadLimits = DEFAULT_LIMITS) -> NumberRows:
    """Read a text that holds nothing but numbers and white space.

    Raises
    ------
    ReadError
        If a word is not a number, then the message gives its line; or if there are too many of them.
    """
    values: list[Floats] = []
    offsets: list[Indices] = []
    lines: list[Indices] = []
    line, count = first_line, 0
    for block in _blocks(text):
        numbers = _numbers(block, line)
        firsts, rows = _row_begins(block, line)
        if lines and len(rows) and rows[0] == lines[-1][-1]:  # the row goes on from the block before
            firsts, rows = firsts[1:], rows[1:]
        if len(rows):
            offsets.append(firsts + count)
            lines.append(rows)
        values.append(numbers)
        line, count = line + block.count(b"\n"), count + len(numbers)
        limits.check_numbers(count)
    none = np.zeros(0, dtype=np.int64)
    return NumberRows(
        np.concatenate([np.zeros(0), *values]),
        np.append(np.concatenate([none, *offsets]), count),
        np.concatenate([none, *lines]),
    )


def unix_lines(content: bytes) -> bytes:
    """Return the text with every line ended by a newline alone, as all line patterns here expect."""
    return content.replace(b"\r\n", b"\n").replace(b"\r", b"\n")


def whole(values: Floats) -> Mask:
    """Return which numbers are integers that float64 and int64 both hold exactly."""
    integral: Mask = (values == np.floor(values)) & (np.abs(values) < 2**53)
    return integral


def quoted(word: bytes) -> str:
    """Return a word of a file as it can be shown in a message, on one line and not too long."""
    return repr(word[:40].decode("utf-8", errors="replace"))


def _blocks(text: bytes) -> Iterator[bytes]:
    """Cut a text between words into pieces of about the same length."""
    begin = 0
    while begin < len(text):
        gap = _GAP.search(text, begin + _BLOCK_BYTES)
        end = len(text) if gap is None else gap.start()
        yield text[begin:end]
        begin = end


def _numbers(block: bytes, first_line: int) -> Floats:
    words = block.split()
    try:
        return np.fromiter(map(float, words), dtype=np.float64, count=len(words))
    except ValueError:
        place = next(place for place, word in enumerate(words) if not _is_number(word))
    firsts, rows = _row_begins(block, first_line)
    line = rows[np.searchsorted(firsts, place, side="right") - 1]
    raise ReadError(f"line {line}: a number was expected, found {quoted(words[place])}")


def _row_begins(block: bytes, first_line: int) -> tuple[Indices, Indices]:
    """Return which word each row begins with, and the line that it stands on."""
    codes = np.frombuffer(block, dtype=np.uint8)
    blank = _BLANK[codes]
    words = np.flatnonzero(~blank & np.concatenate([[True], blank[:-1]]))
    lines = first_line + np.searchsorted(np.flatnonzero(codes == ord("\n")), words)
    firsts = np.flatnonzero(np.diff(lines, prepend=first_line - 1))
    return firsts, lines[firsts]


def _is_number(word: bytes) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
