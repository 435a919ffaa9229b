"""Drawings of the curve as SVG files in true size, for plotters, lasers and pages."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from pathlib import Path

import numpy as np

from fabricate.arrays import Floats
from fabricate.output.files import write_whole
from fabricate.picture.line_drawing import LineDrawing

MARGIN = 2.0
"""Empty space around the body, mm."""

STROKE = 0.3
"""Width of a line, mm."""

VISIBLE, HIDDEN = "#000000", "#bbbbbb"

PAGE = """<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}">
<title>{title}</title>
{paths}
</svg>
"""
PATH = (
    '<path id="{name}" fill="none" stroke="{colour}" stroke-width="{stroke}" stroke-linecap="round" '
    'stroke-linejoin="round" d="{strokes}"/>'
)


def write_curve_svg(path: Path, drawing: LineDrawing, *, title: str, with_hidden: bool = False) -> None:
    """Write a drawing with one path "visible", and before it one path "hidden" if asked for; one unit is one mm.

    Raises
    ------
    OutputError
        If the file can't be written.
    """
    paths = [_path("visible", VISIBLE, drawing.visible)]
    if with_hidden:
        paths.insert(0, _path("hidden", HIDDEN, drawing.hidden))
    text = PAGE.format(
        width=_shown(drawing.width + 2.0 * MARGIN),
        height=_shown(drawing.height + 2.0 * MARGIN),
        title=escape(f"{title}, {drawing.view}"),
        paths="\n".join(paths),
    )
    write_whole(path, text.encode())


def _path(name: str, colour: str, strokes: Iterable[Floats]) -> str:
    return PATH.format(name=name, colour=colour, stroke=STROKE, strokes=" ".join(map(_stroke, strokes)))


def _stroke(points: Floats) -> str:
    """Return a stroke as commands of a path, to a thousandth of a mm."""
    closed = len(points) > 2 and np.array_equal(points[0], points[-1])
    pairs = [f"{_shown(x)},{_shown(y)}" for x, y in points[: -1 if closed else None] + MARGIN]
    return "M" + " L".join(pairs) + ("Z" if closed else "")


def _shown(length: float) -> str:
    return f"{length:.3f}".rstrip("0").rstrip(".")
