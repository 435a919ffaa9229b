"""Number rows are the lines that hold numbers, and a word that is none is named with its line."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.errors import ReadError
from fabricate.formats.limits import ReadLimits
from fabricate.formats.number_rows import number_rows, quoted, unix_lines, whole


@given(st.lists(st.lists(st.floats(allow_nan=False), max_size=4), max_size=8))
def test_number_rows_are_the_lines_that_hold_numbers(table: list[list[float]]) -> None:
    rows = number_rows("\n".join("\t ".join(map(repr, row)) for row in table).encode(), first_line=5)
    filled = {line: row for line, row in enumerate(table, start=5) if row}
    assert rows.lines.tolist() == list(filled)
    assert rows.sizes.tolist() == [len(row) for row in filled.values()]
    assert rows.values.tolist() == [value for row in filled.values() for value in row]


@pytest.mark.parametrize("text", [b"", b" \n\t\n"])
def test_a_text_without_numbers_has_no_rows(text: bytes) -> None:
    rows = number_rows(text)
    assert (len(rows.values), rows.offsets.tolist(), rows.lines.tolist()) == (0, [0], [])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (b"1 2\n\n3 four 5", "line 9: a number was expected, found 'four'"),
        (b"x", "line 7: a number was expected, found 'x'"),
        (b"1 \xff", "line 7: a number was expected, found '\ufffd'"),
        (b"1\n0x10", "line 8: a number was expected, found '0x10'"),
    ],
)
def test_a_word_is_named_with_its_line(text: bytes, message: str) -> None:
    with pytest.raises(ReadError) as caught:
        number_rows(text, first_line=7)
    assert str(caught.value) == message


@given(st.lists(st.sampled_from(["a b", "", " "]), min_size=1), st.sampled_from(["\n", "\r\n", "\r"]))
def test_lines_end_in_one_way(lines: list[str], end: str) -> None:
    assert unix_lines(end.join(lines).encode()).decode().split("\n") == lines


def test_whole_numbers_are_those_that_integers_hold_exactly() -> None:
    values = np.array([0.0, -3.0, 2.0**53 - 1, 2.5, 2.0**53, -(2.0**60), np.inf, np.nan])
    assert whole(values).tolist() == [True, True, True, False, False, False, False, False]


@given(st.binary())
def test_a_word_is_shown_on_one_short_line(word: bytes) -> None:
    shown = quoted(word)
    assert shown.isprintable()
    assert len(shown) <= 402


@pytest.mark.parametrize("end", ["\n", " ", "\n\n"])
def test_long_texts_are_read_as_short_ones(end: str) -> None:
    table = np.random.default_rng(4).normal(size=(40_000, 3))
    text = end.join(" ".join(map(repr, row)) for row in table.tolist()).encode()
    assert len(text) > 2 << 20
    rows = number_rows(text)
    assert rows.values.tolist() == table.ravel().tolist()
    if end == " ":
        assert (rows.offsets.tolist(), rows.lines.tolist()) == ([0, table.size], [1])
    else:
        assert rows.offsets.tolist() == list(range(0, table.size + 1, 3))
        assert rows.lines.tolist() == list(range(1, len(end) * len(table) + 1, len(end)))
    last = text.count(b"\n") + 2
    with pytest.raises(ReadError, match=f"line {last}: a number was expected, found 'x'"):
        number_rows(text + b"\n1 x")


def test_numbers_are_counted_against_the_limits() -> None:
    limits = ReadLimits(max_faces=1)
    assert len(number_rows(b"1 " * limits.max_numbers, limits=limits).values) == limits.max_numbers
    with pytest.raises(ReadError, match=r"prepare\.max_faces"):
        number_rows(b"1 " * (limits.max_numbers + 1), limits=limits)
