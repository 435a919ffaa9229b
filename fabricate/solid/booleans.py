"""Booleans: parts as Manifold holds them, and back as files will hold them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from manifold3d import Error, Manifold, Mesh64

from fabricate.arrays import Floats
from fabricate.errors import SolidError
from fabricate.solid.part import Part


class Cylinder(NamedTuple):
    """A round bar from one point, (3,), to another, mm."""

    begin: Floats
    end: Floats
    radius: float


def manifold_of(part: Part) -> Manifold:
    """Return a part as Manifold holds it; a part without triangles is empty.

    Raises
    ------
    SolidError
        If Manifold does not take it.
    """
    if not len(part.triangles):
        return Manifold()
    taken = Manifold(Mesh64(part.points.copy(), part.triangles.astype(np.uint64)))
    if taken.status() != Error.NoError:
        raise SolidError(f"{part.name} is no solid to add to or to take from: Manifold says {taken.status().name}")
    return taken


def part_of(name: str, manifold: Manifold) -> Part:
    """Return what Manifold holds as a part, its coordinates rounded to float32."""
    mesh = manifold.to_mesh64()
    points = np.asarray(mesh.vert_properties)[:, :3]
    return Part(name, points, np.asarray(mesh.tri_verts).astype(np.int64))


def bar(cylinder: Cylinder, *, tolerance: float, turn: float = 0.0) -> Manifold:
    """Return a round bar, as many-sided as the chord error, mm, asks for and turned about its axis by `turn` degrees.

    Its sides lie outside of the circle by as much as their middles lie inside, so that it holds the circle's area.
    """
    way = cylinder.end - cylinder.begin
    length = float(np.linalg.norm(way))
    sides = max(24, int(np.ceil(np.pi / np.sqrt(2.0 * tolerance / cylinder.radius))))
    angle = 2.0 * np.pi / sides
    radius = cylinder.radius * float(np.sqrt(angle / np.sin(angle)))
    standing = Manifold.cylinder(length, radius, radius, sides).rotate([0.0, 0.0, turn])
    frame = np.column_stack([*_across(way / length), way / length, cylinder.begin])
    return standing.transform(frame)


def united(solids: Sequence[Manifold]) -> Manifold:
    """Return the union of some solids."""
    whole = Manifold()
    for solid in solids:
        whole = whole + solid
    return whole


def _across(way: Floats) -> tuple[Floats, Floats]:
    """Return two unit vectors, (3,), at right angles to a unit vector and to each other, right-handed with it."""
    aside = np.eye(3)[np.abs(way).argmin()]
    first = np.cross(way, aside)
    first = first / np.linalg.norm(first)
    return first, np.cross(way, first)
