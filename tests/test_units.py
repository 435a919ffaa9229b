"""Lengths survive being written and read, and everything that is not a length is refused."""

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.errors import ConfigError
from fabricate.units import ANGLE_PATTERN, LENGTH_PATTERN, format_angle, format_length, parse_angle, parse_length

FINITE = st.floats(allow_nan=False, allow_infinity=False)


@given(FINITE)
def test_a_length_survives_writing_and_reading_exactly(length: float) -> None:
    assert parse_length(format_length(length)) == length


@given(FINITE)
def test_what_is_written_matches_the_pattern_that_editors_check(length: float) -> None:
    assert re.fullmatch(LENGTH_PATTERN, format_length(length))


@pytest.mark.parametrize(
    ("text", "mm"),
    [
        ("0.3 mm", 0.3),
        ("0.3mm", 0.3),
        ("  2 mm ", 2.0),
        ("2. mm", 2.0),
        (".5 mm", 0.5),
        ("1.2 cm", 12.0),
        ("1 in", 25.4),
        ("1e-3 cm", 0.01),
        ("+4 mm", 4.0),
        ("-1 mm", -1.0),
    ],
)
def test_units_and_spellings(text: str, mm: float) -> None:
    assert parse_length(text) == pytest.approx(mm, rel=1e-15)


@given(st.floats(min_value=1e-9, max_value=1e9))
def test_an_inch_is_longer_than_a_centimetre_is_longer_than_a_millimetre(number: float) -> None:
    inch, centimetre, millimetre = (parse_length(f"{number!r} {unit}") for unit in ("in", "cm", "mm"))
    assert inch / centimetre == pytest.approx(2.54)
    assert centimetre / millimetre == pytest.approx(10)


@pytest.mark.parametrize("text", ["3", " 0.3 ", "1e2"])
def test_a_bare_number_is_told_to_take_a_unit(text: str) -> None:
    with pytest.raises(ConfigError, match=f'write "{re.escape(text.strip())} mm"'):
        parse_length(text)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "mm",
        "nan mm",
        "inf mm",
        "-inf mm",
        "1e999 mm",
        "1e308 cm",
        "2 m",
        "2 MM",
        "2 mm mm",
        "1_0 mm",
        "٣ mm",
    ],
)
def test_anything_else_is_refused_and_quoted(text: str) -> None:
    with pytest.raises(ConfigError, match=f'expected a length.*"{re.escape(text)}"'):
        parse_length(text)


def test_whole_millimetres_are_written_without_a_fraction() -> None:
    assert format_length(100.0) == "100 mm"
    assert format_length(0.3) == "0.3 mm"
    assert math.copysign(1, parse_length(format_length(-0.0))) == -1


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_an_angle_survives_writing_and_reading_exactly(angle: float) -> None:
    text = format_angle(angle)
    assert parse_angle(text) == angle
    assert re.match(ANGLE_PATTERN, text)
