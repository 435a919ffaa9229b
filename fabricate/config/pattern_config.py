"""The section [pattern]: how the curve runs."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from fabricate.config.handles_config import Handles, HandlesConfig
from fabricate.config.length import Length
from fabricate.config.lock_config import LockConfig
from fabricate.config.point import Point, as_tuple
from fabricate.config.ring_positions import HIGHEST, LOWEST, RING_DESIGNS, RingDesign, Rings
from fabricate.config.section import Section, wrong_value
from fabricate.config.takes import Takes

ALTERNATIVES: Mapping[str, str] = MappingProxyType({"levels": "tile_size", "rings": "arc", "area_share": "arc"})
"""Keys that are given instead of others, and these others, which have a default."""

_ONE_OF_THREE = "expected one of arc, rings and area_share"


class PatternConfig(Section):
    """The curve: one closed line that winds over the whole surface, or several side by side."""

    tile_size: Literal["auto"] | Annotated[Length, Field(gt=0)] | None = Field(
        default=7.0, json_schema_extra={"default": "7 mm"}
    )
    """Side of the tiles that the curve runs through, or "auto": the finest that prints; instead of levels."""
    levels: Annotated[int, Field(ge=0, le=12)] | None = Field(default=None, examples=[2])
    """How often the quads are divided in four; instead of tile_size."""
    tree: Literal["random", "uniform", "breadth-first", "depth-first", "field"] = "random"
    """Spanning tree that the yellow region grows along; a random one avoids necks that are too narrow to print."""
    seed: Annotated[int, Field(ge=0)] = 0
    """Another seed gives another random tree, the same seed always the same."""
    root: Point | None = Field(default=None, examples=[["0 mm", "0 mm", "50 mm"]])
    """Place on the sculpture that breadth-first and depth-first trees grow from; drawn from seed unless given."""
    arc: Annotated[float, Field(gt=LOWEST, lt=HIGHEST)] | None = Field(default=0.5)
    """Where the curve crosses tile edges, from the yellow end; more gives yellow a larger share."""
    rings: RingDesign | Rings | None = Field(default=None, examples=["three"])
    """Several such places, for bands between yellow and blue along the whole curve; instead of arc."""
    area_share: Annotated[float, Field(gt=0, lt=1)] | None = Field(default=None, examples=[0.6])
    """Yellow's share of the surface, met within 0.001 by the arc position that gives it; instead of arc."""
    handles: Handles = HandlesConfig()
    """Handles of the surface that yellow gets, such as { yellow = 1 }; even: half of them, and blue the odd one."""
    locks: Annotated[tuple[LockConfig, ...], BeforeValidator(as_tuple), Takes("tables [[pattern.locks]]")] | None = (
        Field(default=None, examples=[[{"joined": "yellow", "tiles": [4, 5]}]])
    )
    """Tiles that are joined in one colour, whatever the tree."""

    @model_validator(mode="before")
    @classmethod
    def _alternatives_replace_defaults(cls, data: object) -> object:
        if not isinstance(data, dict):
            return data
        return {**{default: None for key, default in ALTERNATIVES.items() if key in data}, **data}

    @model_validator(mode="after")
    def _one_of_each(self) -> Self:
        if (self.levels is None) == (self.tile_size is None):
            raise wrong_value("pattern.levels", "expected either tile_size or levels, not both: remove one")
        found = [key for key in ("arc", "rings", "area_share") if getattr(self, key) is not None]
        if len(found) != 1:
            what = " and ".join(found) or "none"
            raise wrong_value(f"pattern.{found[-1] if found else 'arc'}", f"{_ONE_OF_THREE}, found {what}: keep one")
        return self

    @property
    def positions(self) -> tuple[float, ...]:
        """Where curves cross tile edges, from the yellow end: one for a duotone."""
        if isinstance(self.rings, str):
            return RING_DESIGNS[self.rings]
        return self.rings or (self.arc or 0.5,)
