"""How messages name numbers of things and places."""

from __future__ import annotations

from collections.abc import Iterable


def counted(number: int, noun: str, plural: str = "") -> str:
    """Return "1 edge", "2 edges"; `plural` is for nouns that don't simply take an s."""
    return f"{number} {noun if number == 1 else plural or noun + 's'}"


def place(point: Iterable[float]) -> str:
    """Return a point as "(x, y, z)" with six significant digits."""
    return "(" + ", ".join(f"{value:.6g}" for value in point) + ")"
