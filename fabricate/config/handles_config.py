"""The key pattern.handles: how many of the surface's handles go to yellow."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from fabricate.config.section import Section


class HandlesConfig(Section):
    """Handles of yellow; blue gets the others."""

    yellow: Annotated[int, Field(ge=0)] = 0
    """Handles of the yellow region, at most the genus of the surface."""


Handles: TypeAlias = Literal["even"] | HandlesConfig
"""How handles are shared: half of them each, where blue gets the odd one, or a number for yellow."""


def handles_of_yellow(handles: Handles, genus: int) -> int:
    """Return how many handles are asked for in yellow on a surface of this genus; it may have fewer."""
    return genus // 2 if handles == "even" else handles.yellow
