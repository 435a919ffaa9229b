"""Lengths: text with a unit where a file is read, plain mm in Python, and each comes back from the other."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter, ValidationError

from fabricate.config.length import Length
from fabricate.config.section import ConfigFolder

LENGTH: TypeAdapter[float] = TypeAdapter(Length)
FILE = ConfigFolder(Path())


@pytest.mark.parametrize(("text", "mm"), [("2 mm", 2.0), ("0.2cm", 2.0), ("1 in", 25.4), ("-1 mm", -1.0)])
def test_text_is_read_with_its_unit(text: str, mm: float) -> None:
    assert LENGTH.validate_python(text) == mm
    assert LENGTH.validate_python(text, context=FILE) == mm


def test_a_number_is_mm_in_python_and_lacks_its_unit_in_a_file() -> None:
    assert LENGTH.validate_python(2.5) == 2.5
    with pytest.raises(ValidationError, match=r"with a unit, found 2\.5"):
        LENGTH.validate_python(2.5, context=FILE)


@pytest.mark.parametrize("value", [True, None, [1], "wide", "2"])
def test_anything_else_is_no_length(value: object) -> None:
    for context in (None, FILE):
        with pytest.raises(ValidationError):
            LENGTH.validate_python(value, strict=True, context=context)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_what_is_written_is_read_as_the_same_float(mm: float) -> None:
    written = LENGTH.dump_python(mm, mode="json")
    assert isinstance(written, str)
    assert LENGTH.validate_python(written, context=FILE) == mm
