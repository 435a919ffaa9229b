"""The type of every key that is a length: text with a unit in a file, mm everywhere else."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import BeforeValidator, PlainSerializer, ValidationInfo, WithJsonSchema

from fabricate.config.section import ConfigFolder
from fabricate.units import LENGTH_PATTERN, format_length, parse_length


def _length_in_mm(value: object, info: ValidationInfo) -> object:
    """Read a length written in a file; a number from Python is in mm already."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if isinstance(value, str) or (is_number and isinstance(info.context, ConfigFolder)):
        return parse_length(str(value))
    return value


Length: TypeAlias = Annotated[
    float,
    BeforeValidator(_length_in_mm),
    PlainSerializer(format_length, return_type=str, when_used="json"),
    WithJsonSchema({"type": "string", "pattern": LENGTH_PATTERN}),
]
