"""Lengths and angles: text such as "0.3 mm" and "40 deg" in configs and on the command line, floats elsewhere."""

from __future__ import annotations

import math
import re

from fabricate.errors import ConfigError

MM_PER_UNIT = {"mm": 1.0, "cm": 10.0, "in": 25.4}
_NUMBER = r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?"
LENGTH_PATTERN = rf"^\s*{_NUMBER}\s*({'|'.join(MM_PER_UNIT)})\s*$"
ANGLE_PATTERN = rf"^\s*{_NUMBER}\s*deg\s*$"
_ANGLE = re.compile(rf"\s*(?P<number>{_NUMBER})\s*(?P<unit>deg)?\s*")
_LENGTH = re.compile(rf"\s*(?P<number>{_NUMBER})\s*(?P<unit>{'|'.join(MM_PER_UNIT)})?\s*")


def parse_length(text: str) -> float:
    """Return the length in mm that a text such as "0.3 mm", "1.2cm" or ".5 in" stands for.

    Raises
    ------
    ConfigError
        If the unit is missing, or the text is anything but a finite number and a unit.
    """
    match = _LENGTH.fullmatch(text)
    if match is None or not math.isfinite(float(match["number"])):
        raise ConfigError(f'expected a length such as "2.4 mm" ({", ".join(MM_PER_UNIT)}), found "{text}"')
    if match["unit"] is None:
        raise ConfigError(f'expected a length with a unit, found {text.strip()}: write "{text.strip()} mm"')
    length = float(match["number"]) * MM_PER_UNIT[match["unit"]]
    if not math.isfinite(length):
        raise ConfigError(f'expected a length that a float can hold, found "{text}"')
    return length


def parse_angle(text: str) -> float:
    """Return the angle in degrees that a text such as "40 deg" stands for.

    Raises
    ------
    ConfigError
        If the unit is missing, or the text is anything but a finite number and "deg".
    """
    match = _ANGLE.fullmatch(text)
    if match is None or not math.isfinite(float(match["number"])):
        raise ConfigError(f'expected an angle such as "40 deg", found "{text}"')
    if match["unit"] is None:
        raise ConfigError(f'expected an angle with a unit, found {text.strip()}: write "{text.strip()} deg"')
    return float(match["number"])


def format_angle(angle: float) -> str:
    """Return an angle in degrees as text that `parse_angle` turns back into exactly the same float."""
    return f"{float(angle)!r}".removesuffix(".0") + " deg"


def format_length(length: float) -> str:
    """Return a length in mm as text that `parse_length` turns back into exactly the same float."""
    return f"{float(length)!r}".removesuffix(".0") + " mm"
