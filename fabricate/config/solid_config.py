"""The section [solid]: the parts that are made of the two regions."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from fabricate.config.length import Length
from fabricate.config.section import Section


class SolidConfig(Section):
    """The parts: two solids that interlock."""

    thickness: Annotated[Length, Field(gt=0)] = 2.4
    """Thickness of the walls; the process decides unless it is given."""
    core: Literal["hollow", "blue", "yellow"] = "hollow"
    """Part that keeps the inside; hollow: neither does."""
    clearance: Annotated[Length, Field(ge=0)] = 0.3
    """Gap between facing walls, 0 mm for a two-colour job; the process decides unless it is given."""
    tolerance: Annotated[Length, Field(gt=0)] = 0.05
    """How far the triangles may lie from the true surface."""
