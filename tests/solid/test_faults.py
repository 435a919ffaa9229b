"""Faults: none in a sound assembly; planted crossings and near places are found where they were planted."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.torus import torus
from fabricate.solid.assembly import Assembly, assembly
from fabricate.solid.faults import crossing_points, near_points
from fabricate.solid.settling import fitted_cut
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled

THICKNESS, CLEARANCE = 1.0, 0.3


@pytest.fixture(scope="module")
def surface() -> CutSurface:
    quads = tiled(sized(torus(around=8, across=4, tube=0.45), size=60), tile_size=12)
    return fitted_cut(grown_duotone(quads, tree="random", seed=3), tolerance=0.2, clearance=CLEARANCE)


def built(surface: CutSurface, clearance: float) -> Assembly:
    return assembly(surface, surface.points - THICKNESS * surface.normals, clearance=clearance, core="hollow")


def everywhere(surface: CutSurface) -> np.ndarray:
    return np.ones(len(surface.points), dtype=bool)


def inside_yellow(surface: CutSurface) -> int:
    """Return the number of a point that no clearance moves: the yellow end of a ray."""
    return int(surface.rays[0, 1, -1])


@pytest.mark.parametrize("clearance", [0.0, CLEARANCE])
def test_a_sound_assembly_has_no_crossing(surface: CutSurface, clearance: float) -> None:
    made = built(surface, clearance)
    assert not crossing_points(made, clearance=clearance, moved=everywhere(surface)).any()


@pytest.mark.parametrize("clearance", [0.0, CLEARANCE])
def test_an_inner_point_outside_crosses(surface: CutSurface, clearance: float) -> None:
    made, number = built(surface, clearance), inside_yellow(surface)
    points = made.points.copy()
    points[len(surface.points) + number] = surface.points[number] + 2.0 * surface.normals[number]
    planted = replace(made, points=points)
    found = crossing_points(planted, clearance=clearance, moved=everywhere(surface))
    assert found[number]
    far = np.linalg.norm(surface.points - surface.points[number], axis=1) > 15.0
    assert not found[far].any()


def test_looking_around_the_moved_point_finds_as_much(surface: CutSurface) -> None:
    made, number = built(surface, CLEARANCE), inside_yellow(surface)
    points = made.points.copy()
    points[len(surface.points) + number] = surface.points[number] + 2.0 * surface.normals[number]
    planted, moved = replace(made, points=points), np.arange(len(surface.points)) == number
    near, whole = (crossing_points(planted, clearance=CLEARANCE, moved=m) for m in (moved, everywhere(surface)))
    assert (near == whole).all()


def test_a_fold_of_the_outer_surface_alone_is_a_fault(surface: CutSurface) -> None:
    """An outer point is pulled out and over its neighbours."""
    made, number = built(surface, CLEARANCE), inside_yellow(surface)
    beside = surface.triangles[(surface.triangles == number).any(axis=1)].ravel()
    way = surface.points[beside] - surface.points[number]
    points = made.points.copy()
    points[number] += 2.5 * way[np.linalg.norm(way, axis=1).argmax()] + 0.2 * surface.normals[number]
    found = crossing_points(replace(made, points=points), clearance=CLEARANCE, moved=everywhere(surface))
    assert found[number]
    assert not found[np.linalg.norm(surface.points - surface.points[number], axis=1) > 15.0].any()


def test_an_outer_edge_moved_over_is_near(surface: CutSurface) -> None:
    made, count, number = built(surface, CLEARANCE), len(surface.points), int(surface.curves[0, 7])
    points = made.points.copy()
    points[number] = 0.3 * points[number] + 0.7 * points[2 * count + number]
    found = near_points(replace(made, points=points), clearance=CLEARANCE, moved=everywhere(surface))
    assert found[number]
    assert not found[np.linalg.norm(surface.points - surface.points[number], axis=1) > 10.0].any()


def test_an_inner_wall_moved_over_is_near(surface: CutSurface) -> None:
    made, count = built(surface, CLEARANCE), len(surface.points)
    number = int(surface.curves[0, 7])
    yellow, blue = count + number, 3 * count + number
    points = made.points.copy()
    points[yellow] = 0.2 * points[yellow] + 0.8 * points[blue]
    found = near_points(replace(made, points=points), clearance=CLEARANCE, moved=everywhere(surface))
    assert found[number]
    assert not found[np.linalg.norm(surface.points - surface.points[number], axis=1) > 10.0].any()


def test_what_is_twice_as_far_as_asked_is_not_near(surface: CutSurface) -> None:
    assert not near_points(built(surface, CLEARANCE), clearance=0.5 * CLEARANCE, moved=everywhere(surface)).any()


def test_what_is_half_as_far_as_asked_is(surface: CutSurface) -> None:
    assert near_points(built(surface, CLEARANCE), clearance=2.0 * CLEARANCE, moved=everywhere(surface))[
        surface.curves
    ].all()
