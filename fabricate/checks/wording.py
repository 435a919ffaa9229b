"""How messages name numbers of things and places."""

from __future__ import annotations

from collections.abc import Iterable

LEAST_SHARE = 1e-4
"""Smallest share that is said as it is."""


def counted(number: int, noun: str, plural: str = "") -> str:
    """Return "1 edge", "2 edges"; `plural` is for nouns that don't simply take an s."""
    return f"{number} {noun if number == 1 else plural or noun + 's'}"


def told_apart(found: float, limit: float) -> str:
    """Return a number with four significant digits, or as many more as it takes to tell it from a limit."""
    digits = 4
    while digits < 17 and found != limit and float(f"{found:.{digits}g}") == float(f"{limit:.{digits}g}"):
        digits += 1
    return f"{found:.{digits}g}"


def share_of(share: float) -> str:
    """Return a share in percent, such as "1.25%"; what would be rounded to none is "less than 0.01%"."""
    return f"{share:.2%}" if share >= LEAST_SHARE else f"less than {LEAST_SHARE:.2%}"


def place(point: Iterable[float]) -> str:
    """Return a point as "(x, y, z)" with six significant digits."""
    return "(" + ", ".join(f"{value:.6g}" for value in point) + ")"
