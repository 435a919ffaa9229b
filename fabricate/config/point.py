"""The types of keys that are a point, of three lengths, or a direction, of three numbers."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import AfterValidator, BeforeValidator

from fabricate.config.length import Length
from fabricate.config.takes import Takes


def as_tuple(value: object) -> object:
    """Return a list, as files have it, as a tuple."""
    return tuple(value) if isinstance(value, list) else value


def _some_way(value: tuple[float, float, float]) -> tuple[float, float, float]:
    if not any(value):
        raise ValueError("expected a direction, found three zeros")
    return value


Point: TypeAlias = Annotated[
    tuple[Length, Length, Length], BeforeValidator(as_tuple), Takes('three lengths such as ["0 mm", "0 mm", "50 mm"]')
]
"""x, y and z of a place on the finished sculpture, mm."""

Direction: TypeAlias = Annotated[
    tuple[float, float, float],
    BeforeValidator(as_tuple),
    AfterValidator(_some_way),
    Takes("three numbers such as [0, 0, 1]"),
]
"""A direction, of any length but zero."""
