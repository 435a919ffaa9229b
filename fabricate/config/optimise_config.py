"""The section [optimise]: what the curve is made better for."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import Field

from fabricate.config.section import Section

Weight: TypeAlias = Annotated[float, Field(ge=0, le=1000)]
EitherWay: TypeAlias = Annotated[float, Field(ge=-1000, le=1000)]


class OptimiseConfig(Section):
    """How much each objective counts when flips of tiles make the curve better; not done while all are 0."""

    neck: Weight = 0.0
    """Wide necks, the narrowest above all."""
    evenness: Weight = 0.0
    """The same share of yellow everywhere."""
    alignment: Weight = 0.0
    """Corridors that run as a field of directions says."""
    tips: EitherWay = 0.0
    """Few ends of corridors; many if it is negative."""
    corridor: EitherWay = 0.0
    """A long way between the farthest ends of yellow; a short one if it is negative."""
    flips: Annotated[int, Field(ge=0, le=100_000_000)] = 20_000
    """How many flips are tried; about 20 for each tile are enough, and with 0 the objectives are only measured."""
    seconds: Annotated[float, Field(gt=0)] | None = Field(default=None, examples=[60.0])
    """Ends it after this time with the best so far, which need not be the same in every run; no limit unless given."""

    @property
    def total(self) -> float:
        """How much all objectives count together; 0 if none does."""
        return self.neck + self.evenness + self.alignment + abs(self.tips) + abs(self.corridor)
