"""The type of every key that is an angle: text with a unit in a file, degrees everywhere else."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import BeforeValidator, PlainSerializer, ValidationInfo, WithJsonSchema

from fabricate.config.section import ConfigFolder
from fabricate.units import ANGLE_PATTERN, format_angle, parse_angle


def _angle_in_degrees(value: object, info: ValidationInfo) -> object:
    """Read an angle written in a file; a number from Python is in degrees already."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if isinstance(value, str) or (is_number and isinstance(info.context, ConfigFolder)):
        return parse_angle(str(value))
    return value


Angle: TypeAlias = Annotated[
    float,
    BeforeValidator(_angle_in_degrees),
    PlainSerializer(format_angle, return_type=str, when_used="json"),
    WithJsonSchema({"type": "string", "pattern": ANGLE_PATTERN}),
]
