"""The table process.shop: what a print shop accepts."""

from __future__ import annotations

from typing import Annotated, Self, TypeAlias

from pydantic import AfterValidator, BeforeValidator, Field, model_validator

from fabricate.config.length import Length
from fabricate.config.section import Section, wrong_value
from fabricate.config.takes import Takes


def _as_tuple(value: object) -> object:
    """Return a list, as files have it, as a tuple."""
    return tuple(value) if isinstance(value, list) else value


def _with_room(value: tuple[float, float, float]) -> tuple[float, float, float]:
    if min(value) <= 0.0:
        raise ValueError("expected three lengths of more than 0 mm")
    return value


Box: TypeAlias = Annotated[
    tuple[Length, Length, Length],
    BeforeValidator(_as_tuple),
    AfterValidator(_with_room),
    Takes('three lengths such as ["250 mm", "210 mm", "210 mm"]'),
]
"""The sides of a box, mm."""


class ShopConfig(Section):
    """What a print shop accepts; what is left out has no limit."""

    polygons: Annotated[int, Field(ge=1000, le=100_000_000)] | None = None
    """Most triangles in one file: parts are divided more coarsely until they have no more."""
    file_mb: Annotated[float, Field(gt=0)] | None = None
    """Largest STL file, in megabytes; the same is done for it."""
    box: Box | None = None
    """Largest bounding box of all parts together, whichever way they are laid into it."""
    wall: Annotated[Length, Field(gt=0)] | None = None
    """Thinnest wall and neck."""

    @model_validator(mode="after")
    def _some_limit(self) -> Self:
        if all(getattr(self, key) is None for key in type(self).model_fields):
            raise wrong_value("process.shop", "expected at least one of polygons, file_mb, box, wall, found none")
        return self
