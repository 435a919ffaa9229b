"""The section [curve]: the curve itself, as a wire and as drawings."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import BeforeValidator, Field

from fabricate.config.length import Length
from fabricate.config.point import as_tuple
from fabricate.config.section import Section
from fabricate.config.takes import Takes

View: TypeAlias = Literal["front", "back", "left", "right", "top", "bottom"]
"""A side from which the sculpture is seen; z is up, and the front looks along y."""


class CurveConfig(Section):
    """The curve itself: a wire along it, and drawings of it."""

    wire: Annotated[Length, Field(ge=0.1)] | None = Field(default=None, examples=["1 mm"])
    """Diameter of a wire along the curve, or yellow's of several, made as wire.stl; none unless it is given."""
    views: Annotated[
        tuple[View, ...],
        BeforeValidator(as_tuple),
        Takes('a list of sides: "front", "back", "left", "right", "top" or "bottom"'),
    ] = ()
    """Sides from which the curve is drawn in true size, as curve-front.svg and so on."""
    hidden: Literal["left-out", "lighter"] = "left-out"
    """What becomes of the parts of the curve that the body hides in a drawing."""
