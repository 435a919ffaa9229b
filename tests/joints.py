"""Joints whose freedom is known, from parting planes to balls that turn in their shells."""

from __future__ import annotations

import numpy as np
import trimesh
from manifold3d import Manifold
from scipy.spatial.transform import Rotation

from fabricate.checks.gap import Spacing
from fabricate.solid.part import Part
from fabricate.triangles.search_tree import SearchTree

GAP = 0.3


def part_of(manifold: Manifold) -> Part:
    mesh = manifold.to_mesh64()
    return Part("red", np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64))


def spacing(first: Part, second: Part) -> Spacing:
    trees = (SearchTree.of(part.points, part.triangles) for part in (first, second))
    return Spacing.between(*trees, clearance=GAP)


def turned(part: Part, angle: float, axis: tuple[float, float, float]) -> Part:
    matrix = Rotation.from_rotvec(angle * np.array(axis) / np.linalg.norm(axis)).as_matrix()
    return Part(part.name, part.points @ matrix.T, part.triangles)


def ball(radius: float, shift: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Part:
    mesh = trimesh.creation.icosphere(subdivisions=3, radius=radius)
    return Part("red", mesh.vertices + np.array(shift), mesh.faces)


def case(radius: float, *, shift: tuple[float, float, float] = (0.0, 0.0, 0.0), side: float = 40.0) -> Part:
    """Return a cube with a spherical hollow, its facets parallel to those of `ball`."""
    hollow = ball(radius, shift)
    cube = trimesh.creation.box(3 * [side])
    return Part(
        "blue",
        np.concatenate([cube.vertices, hollow.points]),
        np.concatenate([cube.faces, hollow.triangles[:, ::-1] + len(cube.vertices)]),
    )


def half_balls() -> tuple[Part, Part]:
    whole = Manifold.sphere(20, 64)
    return (
        part_of(whole.trim_by_plane((0, 0, 1), GAP / 2)),
        part_of(whole.trim_by_plane((0, 0, -1), GAP / 2)),
    )


def plate_with_hole(hole: Manifold) -> Part:
    return part_of(Manifold.cube((30, 30, 8), True) - hole)


def arc(tube: float, degrees: float) -> Manifold:
    """Return a piece of a torus of radius 20 round the z axis."""
    circle = Manifold.cylinder(1, tube, tube, 16).slice(0.5)
    return circle.translate((20, 0)).revolve(96, degrees)


def curved_peg() -> tuple[Part, Part]:
    """Return a bent peg and a block with a bent hole, out of which it turns."""
    block = Manifold.cube((16, 24, 12)).translate((10, 2, -6)) - arc(3 + GAP, 90).rotate((0, 0, -20))
    return part_of(arc(3, 60).rotate((0, 0, -10))), part_of(block)


def peg_with_heads() -> tuple[Part, Part]:
    """Return a peg that a plate holds between its two heads."""
    peg = part_of(
        Manifold.cylinder(8 + 2 * GAP, 5, 5, 64, True)
        + Manifold.cylinder(3, 9, 9, 64).translate((0, 0, 4 + GAP))
        + Manifold.cylinder(3, 9, 9, 64).translate((0, 0, -7 - GAP))
    )
    return peg, plate_with_hole(Manifold.cylinder(40, 5 + GAP, 5 + GAP, 64, True))


def ridged_peg() -> tuple[Part, Part]:
    """Return a peg in the hole of a plate, with a ridge half way down and a groove for it all round the hole."""

    def ridged(radius: float, length: float) -> Manifold:
        cones = [Manifold.cylinder(1.2, *ends, 64) for ends in ((radius, radius + 0.9), (radius + 0.9, radius))]
        return Manifold.cylinder(length, radius, radius, 64, True) + cones[0].translate((0, 0, -1.2)) + cones[1]

    return part_of(ridged(5.0, 8.0)), plate_with_hole(ridged(5.0 + GAP, 40.0))


def peg_in_hole(*, round_one: bool) -> tuple[Part, Part]:
    """Return a peg that slides in the hole of a plate along z; a square one does not turn in it."""
    if round_one:
        peg, hole = Manifold.cylinder(20, 5, 5, 64, True), Manifold.cylinder(40, 5 + GAP, 5 + GAP, 64, True)
    else:
        peg, hole = Manifold.cube((10, 10, 20), True), Manifold.cube((10 + 2 * GAP, 10 + 2 * GAP, 40), True)
    return part_of(peg), plate_with_hole(hole)
