"""Which colour each part has, in pictures and in files that hold colours."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle, islice
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fabricate.arrays import Floats

Colour: TypeAlias = tuple[int, int, int]

NAMED: dict[str, Colour] = {
    "yellow": (0xF6, 0xBC, 0x30),
    "blue": (0x27, 0x67, 0xB8),
    "witness": (0xC6, 0x12, 0x2F),
    "plate": (0x27, 0x67, 0xB8),
    "inserts": (0xF6, 0xBC, 0x30),
}
# In this order for parts with any other name: neighbours differ in hue and in lightness.
CYCLE: tuple[Colour, ...] = (
    (0xD9, 0x4F, 0x3D),  # vermilion
    (0x2E, 0x9C, 0x8A),  # teal
    (0x7B, 0x4F, 0xA3),  # violet
    (0x8F, 0xB3, 0x39),  # leaf
    (0xE2, 0x7D, 0xA6),  # rose
    (0x5A, 0x63, 0x6E),  # slate
)


def part_colours(names: Sequence[str]) -> tuple[Colour, ...]:
    """Return one sRGB colour (0..255) per part name; a name given twice has one colour.

    "yellow" and "blue" are what they say, and the arrows of a "witness" are red; the "plate" of a fit coupon is blue
    and what is loose in it, its "inserts", yellow. The others take the colours of a fixed cycle in order.
    """
    others = [name for name in dict.fromkeys(names) if name not in NAMED]
    known = NAMED | dict(zip(others, islice(cycle(CYCLE), len(others)), strict=True))
    return tuple(known[name] for name in names)


def linear_light(encoded: ArrayLike) -> Floats:
    """Decode sRGB values in 0..1 to linear light (IEC 61966-2-1)."""
    values = np.asarray(encoded, dtype=np.float64)
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def encoded_light(linear: NDArray[Any]) -> NDArray[Any]:
    """Encode linear light in 0..1 as sRGB values in 0..1, the inverse of `linear_light`."""
    return np.where(linear <= 0.0031308, linear * 12.92, 1.055 * np.maximum(linear, 0.0) ** (1 / 2.4) - 0.055)
