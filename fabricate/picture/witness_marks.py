"""Marks of a witness: an arrow for each contact that keeps a part captive, from its wall the way it cannot go."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.checks.facts import PairFacts
from fabricate.solid.part import Part
from fabricate.triangles.normals import unit

NAME = "witness"
"""What marks are called among the parts of a picture; their colour goes by it."""

LENGTH = 0.05
"""Length of an arrow as a share of the diagonal of all parts."""

SIDES = 16

PROFILE = np.array([[0.10, 0.0], [0.10, 0.5], [0.28, 0.5]])
"""Radius and height of the rings of an arrow from its foot up, in lengths; foot and tip are points."""


def witness_marks(parts: Sequence[Part], pairs: Mapping[str, PairFacts]) -> Mapping[str, Part]:
    """Return the arrows on each part that is the first of a captive pair, as one mesh, by the part's name."""
    points = np.concatenate([part.points for part in parts])
    length = LENGTH * float(np.linalg.norm(np.ptp(points, axis=0)))
    marks = {}
    for part in parts:
        found = [facts.witness for name, facts in pairs.items() if name.startswith(f"{part.name}-")]
        feet = [foot for each in found if each is not None for foot in each.points]
        ways = [way for each in found if each is not None for way in each.normals]
        if feet:
            marks[part.name] = _arrows(np.array(feet), np.array(ways), length)
    return MappingProxyType(marks)


def _arrows(feet: Floats, ways: Floats, length: float) -> Part:
    """Return an arrow from each foot, (k, 3), along each unit vector, (k, 3)."""
    template, triangles = _arrow()
    helper = np.where(np.abs(ways[:, :1]) < 0.7, [[1.0, 0, 0]], [[0.0, 1, 0]])
    across = unit(np.cross(ways, helper))
    frames = np.stack([across, np.cross(ways, across), ways], axis=1)
    points = feet[:, None, :] + length * np.einsum("pi,kij->kpj", template, frames)
    numbers = triangles + len(template) * np.arange(len(feet))[:, None, None]
    return Part(NAME, points.reshape(-1, 3), numbers.reshape(-1, 3))


def _arrow() -> tuple[Floats, Indices]:
    """Return the points and triangles of one arrow of length 1 along z, counter-clockwise seen from outside."""
    angles = 2 * np.pi * np.arange(SIDES) / SIDES
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    rings = [np.column_stack([radius * circle, np.full(SIDES, height)]) for radius, height in PROFILE]
    points = np.concatenate([*rings, [[0.0, 0, 0], [0.0, 0, 1]]])
    here = np.arange(SIDES)
    ahead = np.roll(here, -1)
    last, foot, tip = (len(rings) - 1) * SIDES, len(points) - 2, len(points) - 1
    sides = [
        side
        for start in range(0, last, SIDES)
        for side in (
            np.column_stack([start + here, start + ahead, start + SIDES + ahead]),
            np.column_stack([start + here, start + SIDES + ahead, start + SIDES + here]),
        )
    ]
    ends = [
        np.column_stack([np.full(SIDES, foot), ahead, here]),
        np.column_stack([np.full(SIDES, tip), last + here, last + ahead]),
    ]
    return points, np.concatenate([*sides, *ends])
