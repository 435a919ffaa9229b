"""Line drawings of the curve: its strokes as they are seen from one side, in true size."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal, TypeAlias

import numpy as np

from fabricate.arrays import Floats, Indices, Mask, frozen
from fabricate.triangles.normals import unit
from fabricate.triangles.ray_casting import first_hits

View: TypeAlias = Literal["front", "back", "left", "right", "top", "bottom"]

VIEWS: Mapping[View, tuple[tuple[int, int, int], tuple[int, int, int]]] = MappingProxyType(
    {
        "front": ((1, 0, 0), (0, 0, 1)),
        "back": ((-1, 0, 0), (0, 0, 1)),
        "left": ((0, -1, 0), (0, 0, 1)),
        "right": ((0, 1, 0), (0, 0, 1)),
        "top": ((1, 0, 0), (0, 1, 0)),
        "bottom": ((1, 0, 0), (0, -1, 0)),
    }
)
"""What points to the right and what points up in each view; right x up points to the eye."""

STEP = 0.2
"""How finely it is found where the curve goes out of sight, mm."""

CLEAR = 0.02
"""How far above the surface its sight is tested, mm: triangles lie a little beside the smooth surface."""

GRAZING = 0.005
"""Sine of the angle to the surface below which a place is seen edge-on, and taken as hidden."""

SHORTEST = 1.0
"""A piece of the curve that is shorter belongs to those before and after it, whether it is seen or not, mm."""


@dataclass(frozen=True, eq=False)
class LineDrawing:
    """The curve as it is seen from one side, in mm, x to the right and y down from the upper left corner.

    Attributes
    ----------
    view : str
    width, height : float
        Of the whole body in this view.
    visible, hidden : tuple of (k, 2) float
        Strokes, in the order of the curve. A stroke that is all of the curve ends where it begins.
    """

    view: View
    width: float
    height: float
    visible: tuple[Floats, ...]
    hidden: tuple[Floats, ...]


def line_drawing(curves: Floats, normals: Floats, points: Floats, triangles: Indices, view: View) -> LineDrawing:
    """Return the drawing of closed curves, (k, c, 3), on a closed mesh, with the mesh's unit normals along them.

    Lengths are in mm. A place is hidden where the mesh turns away or stands before it (ray casting).
    """
    axes = np.asarray(VIEWS[view], dtype=np.float64)
    start, end = (points @ axes.T).min(axis=0), (points @ axes.T).max(axis=0)
    corner = np.array([start[0], end[1]])
    strokes = [
        (shown, frozen((stroke @ axes.T - corner) * (1.0, -1.0), np.float64, (None, 2)))
        for curve, upright in zip(curves, normals, strict=True)
        for shown, stroke in _strokes(curve, upright, np.cross(*axes), points, triangles)
    ]
    return LineDrawing(
        view,
        float(end[0] - start[0]),
        float(end[1] - start[1]),
        tuple(stroke for shown, stroke in strokes if shown),
        tuple(stroke for shown, stroke in strokes if not shown),
    )


def _strokes(
    curve: Floats, normals: Floats, eye: Floats, points: Floats, triangles: Indices
) -> Iterator[tuple[bool, Floats]]:
    """Return the pieces of a closed curve, (k, 3) float each, and whether they are seen."""
    piece, part = _places(curve)
    following = (piece + 1) % len(curve)
    places, upright = (
        (1.0 - part[:, None]) * values[piece] + part[:, None] * values[following] for values in (curve, unit(normals))
    )
    seen = _steadied(_in_sight(places, upright, eye, points, triangles), places)
    for run in _runs(seen):
        yield bool(seen[run[0]]), places[_kept(run, part)]


def _places(curve: Floats) -> tuple[Indices, Floats]:
    """Return places along a closed curve at most a step apart: the piece of each and how far along it lies."""
    lengths = np.linalg.norm(np.roll(curve, -1, axis=0) - curve, axis=1)
    counts = np.maximum(np.ceil(lengths / STEP).astype(np.int64), 1)
    piece = np.repeat(np.arange(len(curve)), counts)
    first = np.repeat(np.cumsum(counts) - counts, counts)
    return piece, (np.arange(len(piece)) - first) / counts[piece]


def _in_sight(places: Floats, normals: Floats, eye: Floats, points: Floats, triangles: Indices) -> Mask:
    """Return which places on a mesh an eye far away in this direction sees, (k,) bool."""
    faces: Mask = normals @ eye > GRAZING
    asked = np.flatnonzero(faces)
    directions = np.tile(eye, (len(asked), 1))
    hits = first_hits(points, triangles, places[asked] + CLEAR * (normals[asked] + directions), directions)
    seen: Mask = np.zeros(len(places), dtype=bool)
    seen[asked[hits.triangle < 0]] = True
    return seen


def _steadied(seen: Mask, places: Floats) -> Mask:
    """Return what is seen, with pieces that are shorter than the shortest one taken as those around them."""
    steps = np.linalg.norm(np.roll(places, -1, axis=0) - places, axis=1)
    steady = seen.copy()
    for shown in (False, True):
        for run in _runs(steady):
            if steady[run[0]] == shown and len(run) < len(seen) and steps[run[:-1]].sum() < SHORTEST:
                steady[run[:-1]] = not shown
    return steady


def _runs(seen: Mask) -> list[Indices]:
    """Return the places of each piece that is seen or hidden as a whole, each with the first place of the next."""
    count = len(seen)
    begins = np.flatnonzero(seen != np.roll(seen, 1))
    if not len(begins):
        return [np.arange(count + 1) % count]
    ends = np.append(begins[1:], begins[0] + count)
    return [np.arange(begin, end + 1) % count for begin, end in zip(begins, ends, strict=True)]


def _kept(run: Indices, part: Floats) -> Indices:
    """Return those places of a piece that are needed to draw it: points of the curve, and its ends."""
    needed = part[run] == 0.0
    needed[[0, -1]] = True
    kept: Indices = run[needed]
    return kept
