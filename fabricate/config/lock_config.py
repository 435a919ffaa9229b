"""An entry of [[pattern.locks]]: tiles that are joined in one colour, whatever the tree."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from fabricate.config.length import Length
from fabricate.config.point import Direction, Point, as_tuple
from fabricate.config.section import Section
from fabricate.config.takes import Takes


class SideConfig(Section):
    """One side of a plane."""

    point: Point
    """A point of the plane."""
    normal: Direction
    """Towards the side that is meant."""


class LockConfig(Section):
    """Tiles that are joined in one colour."""

    joined: Literal["yellow", "blue"]
    """Colour that is joined across the tiles."""
    hold: Literal["all", "most"] = "all"
    """Every one of the tiles, or as many of them as one curve allows."""
    tiles: (
        Annotated[
            tuple[Annotated[int, Field(ge=0)], ...],
            Field(min_length=1),
            BeforeValidator(as_tuple),
            Takes("numbers of tiles such as [4, 5]"),
        ]
        | None
    ) = Field(default=None, examples=[[4, 5]])
    """The tiles by their numbers, counted from 0."""
    near: Point | None = Field(default=None, examples=[["0 mm", "0 mm", "50 mm"]])
    """Instead of tiles: those whose middle is within a distance of this point."""
    within: Annotated[Length, Field(gt=0)] | None = Field(default=None, examples=["8 mm"])
    """That distance."""
    side: SideConfig | None = Field(default=None, examples=[{"point": ["0 mm", "0 mm", "0 mm"], "normal": [0, 0, 1]}])
    """Instead of tiles: those whose middle is on one side of a plane."""

    @model_validator(mode="after")
    def _one_place(self) -> Self:
        given = [self.tiles is not None, self.near is not None, self.side is not None]
        if sum(given) != 1 or (self.near is None) != (self.within is None):
            raise ValueError("expected one of tiles, near with within, or side")
        return self
