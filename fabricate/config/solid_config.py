"""The section [solid]: the parts that are made of the two regions."""

from __future__ import annotations

from typing import Annotated, Literal, Self, TypeAlias

from pydantic import Discriminator, Field, Tag, model_validator

from fabricate.config.angle import Angle
from fabricate.config.length import Length
from fabricate.config.section import Section, wrong_value
from fabricate.units import format_length

WIDEST_TONGUE = 0.8
"""Largest width of a tongue, as a share of the thickness."""


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


class TongueConfig(Section):
    """The rounded ridge of joint = "tongue"."""

    height: Literal["auto"] | Annotated[Length, Field(gt=0)] = "auto"
    """How far it stands out of the wall; auto: 0.4 mm or a little more than the clearance, where that fits."""
    width: Literal["auto"] | Annotated[Length, Field(gt=0)] = "auto"
    """How wide it is down the wall, at most 0.8 of the thickness; auto: 0.6 to 0.8 of it, more for a tall one."""


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
    joint: Literal["straight", "draft", "tongue"] = "straight"
    """How facing walls run inward: straight, leaning, or with a ridge on one part and its groove in the other."""
    draft: Literal["auto"] | Annotated[Angle, Field(gt=-45, lt=45)] = "auto"
    """How far the walls of joint = "draft" lean: yellow gets wider inside, or narrower if negative; auto: 3 deg."""
    tongue: TongueConfig = Field(default=TongueConfig(), validate_default=True)
    """Ridge of joint = "tongue", at mid-thickness."""
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

    @model_validator(mode="after")
    def _the_tongue_fits_the_wall(self) -> Self:
        widest = WIDEST_TONGUE * self.thickness_range[0]
        width = self.tongue.width
        if self.joint == "tongue" and width != "auto" and width > widest:
            limit, found = format_length(float(f"{widest:.6g}")), format_length(width)
            raise wrong_value("solid.tongue.width", f'expected at most 0.8 of the thickness, {limit}, found "{found}"')
        return self

    @property
    def thickness_range(self) -> tuple[float, float]:
        """The smallest and the largest thickness that is asked for, mm."""
        varying = self.thickness
        return (varying.min, varying.max) if isinstance(varying, ThicknessConfig) else (varying, varying)
