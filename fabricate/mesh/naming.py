"""How messages about meshes name places and numbers of things."""

from __future__ import annotations

from fabricate.arrays import Floats


def place(point: Floats) -> str:
    """Return a point as "(x, y, z)" with six significant digits."""
    return "(" + ", ".join(f"{value:.6g}" for value in point) + ")"


def counted(number: int, noun: str, plural: str = "") -> str:
    """Return "1 edge", "2 edges"; `plural` is for nouns that don't simply take an s."""
    return f"{number} {noun if number == 1 else plural or noun + 's'}"
