"""The section [solid]: the parts that are made of the two regions."""

from __future__ import annotations

from typing import Annotated, Literal, Self, TypeAlias

from pydantic import Discriminator, Field, Tag, model_validator

from fabricate.config.length import Length
from fabricate.config.section import Section, wrong_value
from fabricate.units import format_length


class ThicknessConfig(Section):
    """A wall whose thickness varies."""

    min: Annotated[Length, Field(gt=0)]
    """Thickness where the wall is thinnest: at the top, or where the surface bends most."""
    max: Annotated[Length, Field(gt=0)]
    """Thickness where it is thickest: at the bottom, or where the surface is flattest."""
    by: Literal["curvature", "height"]
    """What the thickness follows."""

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if self.min > self.max:
            limit, found = format_length(self.max), format_length(self.min)
            raise wrong_value("solid.thickness.min", f'expected at most max, {limit}, found "{found}"')
        return self


class OpeningsConfig(Section):
    """Round holes through the walls, by which resin or powder leaves the hollow inside."""

    diameter: Annotated[Length, Field(gt=0)]
    """Width of each."""
    count: Annotated[int, Field(ge=1, le=100)] = 1
    """How many there are."""


class BaseConfig(Section):
    """A flat stand, united with the part that has the lowest point."""

    height: Annotated[Length, Field(gt=0)]
    """By how much it lifts the sculpture."""


def _kind(value: object) -> str:
    return "ThicknessConfig" if isinstance(value, dict | ThicknessConfig) else "a length"


Thickness: TypeAlias = Annotated[
    Annotated[Length, Field(gt=0), Tag("a length")] | Annotated[ThicknessConfig, Tag("ThicknessConfig")],
    Discriminator(_kind),
]
"""A thickness that is the same everywhere, mm, or one that varies."""


class SolidConfig(Section):
    """The parts: two solids that interlock."""

    thickness: Thickness = Field(default=2.4, json_schema_extra={"default": "2.4 mm"})
    """Thickness of the walls; the process decides unless it is given; as a table it varies by height or curvature."""
    core: Literal["hollow", "blue", "yellow"] = "hollow"
    """Part that keeps the inside; hollow: neither does."""
    clearance: Annotated[Length, Field(ge=0)] = 0.3
    """Gap between facing walls, 0 mm for a two-colour job; the process decides unless it is given."""
    tolerance: Annotated[Length, Field(gt=0)] = 0.05
    """How far the triangles may lie from the true surface."""
    openings: OpeningsConfig | None = Field(default=None, examples=[{"diameter": "3.5 mm", "count": 2}])
    """Drain and escape holes into the hollow inside, where they cut no neck; none unless given."""
    base: BaseConfig | None = Field(default=None, examples=[{"height": "3 mm"}])
    """Flat stand under the lowest region; none unless given."""

    @model_validator(mode="after")
    def _only_a_hollow_is_opened(self) -> Self:
        if self.openings is not None and self.core != "hollow":
            message = f'expected none with core = "{self.core}", which keeps no hollow: remove one of the two'
            raise wrong_value("solid.openings", message)
        return self

    @property
    def thickness_range(self) -> tuple[float, float]:
        """The smallest and the largest thickness that is asked for, mm."""
        varying = self.thickness
        return (varying.min, varying.max) if isinstance(varying, ThicknessConfig) else (varying, varying)
