"""Numbers in raised letters: digits of seven straight strokes, as on a pocket calculator, which print at any size.

     top
    _____
   |     |      Strokes overlap where they meet, so that a digit is one solid.
ul |_____| ur
   |     |
ll |_____| lr
    bottom
"""

from __future__ import annotations

from manifold3d import CrossSection, FillRule, Manifold

WIDTH = 0.6
"""Width of a digit, in heights."""

SPACING = 1.6
"""Empty space between letters, in strokes."""

_STROKES = {
    "0": ("top", "ul", "ur", "ll", "lr", "bottom"),
    "1": ("ur", "lr"),
    "2": ("top", "ur", "middle", "ll", "bottom"),
    "3": ("top", "ur", "middle", "lr", "bottom"),
    "4": ("ul", "ur", "middle", "lr"),
    "5": ("top", "ul", "middle", "lr", "bottom"),
    "6": ("top", "ul", "middle", "ll", "lr", "bottom"),
    "7": ("top", "ur", "lr"),
    "8": ("top", "ul", "ur", "middle", "ll", "lr", "bottom"),
    "9": ("top", "ul", "ur", "middle", "lr", "bottom"),
}


def text_width(text: str, *, height: float, stroke: float) -> float:
    """Return how wide a number is, mm, when its digits are `height` mm high and drawn with strokes `stroke` mm wide."""
    return sum(_advance(letter, height, stroke) for letter in text) - SPACING * stroke


def raised_text(text: str, *, height: float, stroke: float, thickness: float) -> Manifold:
    """Return a number of digits and points as a solid that lies on z = 0, its lower left corner at the origin; mm.

    Raises
    ------
    KeyError
        If it has other letters.
    """
    outlines, left = [], 0.0
    for letter in text:
        outlines += [[(left + x, y) for x, y in outline] for outline in _outlines(letter, height, stroke)]
        left += _advance(letter, height, stroke)
    return CrossSection(outlines, FillRule.NonZero).extrude(thickness)


def _advance(letter: str, height: float, stroke: float) -> float:
    return (stroke if letter == "." else WIDTH * height) + SPACING * stroke


def _outlines(letter: str, height: float, stroke: float) -> list[list[tuple[float, float]]]:
    """Return the rectangles that a letter is drawn with, counter-clockwise."""
    if letter == ".":
        return [_rectangle(0.0, 0.0, stroke, stroke)]
    right, top = WIDTH * height, height
    low, high = 0.5 * (height - stroke), 0.5 * (height + stroke)
    strokes = {
        "top": (0.0, top - stroke, right, top),
        "middle": (0.0, low, right, high),
        "bottom": (0.0, 0.0, right, stroke),
        "ul": (0.0, low, stroke, top),
        "ur": (right - stroke, low, right, top),
        "ll": (0.0, 0.0, stroke, high),
        "lr": (right - stroke, 0.0, right, high),
    }
    return [_rectangle(*strokes[name]) for name in _STROKES[letter]]


def _rectangle(left: float, bottom: float, right: float, top: float) -> list[tuple[float, float]]:
    return [(left, bottom), (right, bottom), (right, top), (left, top)]
