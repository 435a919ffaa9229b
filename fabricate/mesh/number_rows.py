"""The rows of numbers that text formats consist of, read with the line that each stands on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.errors import ReadError

_BLANK = np.isin(np.arange(256), np.frombuffer(b" \t\n\r\v\f", dtype=np.uint8))


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


def number_rows(text: bytes, *, first_line: int = 1) -> NumberRows:
    """Read a text that holds nothing but numbers and white space.

    Raises
    ------
    ReadError
        If a word is not a number; the message gives its line.
    """
    codes = np.frombuffer(text, dtype=np.uint8)
    blank = _BLANK[codes]
    begins = np.flatnonzero(~blank & np.concatenate([[True], blank[:-1]]))
    lines = first_line + np.searchsorted(np.flatnonzero(codes == ord("\n")), begins)
    words = text.split()
    try:
        values = np.array(list(map(float, words)), dtype=np.float64)
    except ValueError:
        wrong = next(place for place, word in enumerate(words) if not _is_number(word))
        raise ReadError(f"line {lines[wrong]}: a number was expected, found {quoted(words[wrong])}") from None
    firsts = np.flatnonzero(np.diff(lines, prepend=0))
    return NumberRows(values, np.append(firsts, len(values)), lines[firsts])


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


def _is_number(word: bytes) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
