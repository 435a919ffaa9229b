"""The type of the key that says where several curves cross tile edges: positions, or the name of a design."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from types import MappingProxyType
from typing import Annotated, Literal, TypeAlias

from pydantic import AfterValidator, BeforeValidator

from fabricate.config.takes import Takes

LOWEST, HIGHEST = 0.293, 0.707
"""Between these positions opposite arcs of a tile do not meet."""

RingDesign: TypeAlias = Literal["two", "three", "four"]

RING_DESIGNS: Mapping[RingDesign, tuple[float, ...]] = MappingProxyType(
    {"two": (0.5,), "three": (0.4, 0.6), "four": (0.36, 0.5, 0.615)}
)
"""Tiles of two, three and more regions of different widths, as in figure 4.22 of Garigipati 2013. The positions are
ours: on a square tile necks and bands share 0.414 of its side, and none has less than 0.2, or 0.115 of four regions."""


def _as_tuple(value: object) -> object:
    """Return a list, as files have it, as a tuple."""
    return tuple(value) if isinstance(value, list) else value


def _increasing(rings: tuple[float, ...]) -> tuple[float, ...]:
    if not rings:
        raise ValueError("expected one position or more, found none")
    for ring in rings:
        if not LOWEST < ring < HIGHEST:
            raise ValueError(f"expected positions between {LOWEST:g} and {HIGHEST:g}, found {ring:g}")
    for inner, outer in pairwise(rings):
        if not inner < outer:
            raise ValueError(f"expected positions that increase, found {outer:g} after {inner:g}")
    return rings


Rings: TypeAlias = Annotated[
    tuple[float, ...],
    BeforeValidator(_as_tuple),
    AfterValidator(_increasing),
    Takes("a list of increasing numbers between 0.293 and 0.707 such as [0.4, 0.6]"),
]
"""Fractions of a tile edge, from its yellow end."""
