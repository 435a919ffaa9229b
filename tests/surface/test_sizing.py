from __future__ import annotations

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import named, polyhedra

from fabricate.duotone.catmull_clark import catmull_clark, subdivided
from fabricate.duotone.quad_mesh import two_coloured
from fabricate.errors import PatternError
from fabricate.mesh.crease import creased
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.torus import torus
from fabricate.surface.limit import LimitSurface, Samples
from fabricate.surface.sizing import sized, tile_sides, tiled

NAMED = named()


def dense_box(mesh: PolygonMesh) -> np.ndarray:
    """Return the sides of the bounding box of 60 000 or more points of the limit surface."""
    quads = subdivided(mesh, levels=1)
    count = int(np.ceil(np.sqrt(60_000 / len(quads.tiles)))) + 1
    steps = np.linspace(0, 1, count)
    uv = np.stack(np.meshgrid(steps, steps), axis=2).reshape(-1, 2)
    surface = LimitSurface.of(quads)
    rows = np.arange(len(quads.tiles) * len(uv)).reshape(-1, len(uv))
    operator = surface.operator([Samples(np.arange(len(quads.tiles)), uv, rows)], size=rows.size)
    return np.asarray(np.ptp(operator.positions(surface.control), axis=0))


@pytest.mark.parametrize("name", NAMED)
@pytest.mark.parametrize("size", [0.5, 100.0])
def test_longest_side_of_the_sculpture_is_the_size(name: str, size: float) -> None:
    box = dense_box(sized(NAMED[name], size=size))
    assert box.max() == pytest.approx(size, rel=2e-3)


@settings(max_examples=5)
@given(mesh=polyhedra(), size=st.floats(1, 500), before=st.floats(1e-3, 1e3))
def test_the_size_it_had_does_not_matter(mesh: PolygonMesh, size: float, before: float) -> None:
    once, again = sized(mesh, size=size), sized(mesh.scaled(before), size=size)
    np.testing.assert_allclose(once.points, again.points, rtol=1e-9, atol=1e-12 * size)


def test_shape_is_kept() -> None:
    mesh = NAMED["double torus"]
    larger = sized(mesh, size=80.0)
    factor = larger.points[0] / mesh.points[0]
    np.testing.assert_allclose(larger.points, mesh.points * factor, rtol=1e-12)
    assert larger.corners is mesh.corners


def test_a_cube_with_sharp_edges_is_as_wide_as_its_cage() -> None:
    mesh = sized(creased(cube(divisions=1), angle=40.0), size=60.0)
    np.testing.assert_allclose(np.abs(mesh.points), 30, rtol=1e-14)
    assert mesh.creases.all()
    np.testing.assert_allclose(dense_box(mesh), 60, rtol=1e-12)


def test_tiles_of_a_cube_with_sharp_edges_are_squares_with_creases_on_its_edges() -> None:
    quads = tiled(sized(creased(cube(divisions=3), angle=40.0), size=60.0), tile_size=10.0)
    np.testing.assert_allclose(tile_sides(quads), 10, rtol=1e-12)
    assert quads.creases.sum() == 2 * 12 * 6
    assert np.bincount(quads.crease_counts).tolist() == [6 * 5 * 5, 0, 12 * 5, 8]


def test_torus_is_as_wide_as_its_formula_says() -> None:
    mesh = sized(torus(around=16, across=8, tube=0.5), size=90.0)
    box = dense_box(mesh)
    np.testing.assert_allclose(box, [90, 90, 30], rtol=5e-3)


def test_tile_sides_of_flat_squares() -> None:
    sides = tile_sides(two_coloured(cube(divisions=10).scaled(35)))
    assert len(sides) == 4 * 600
    assert np.isclose(sides, 7, rtol=1e-12).mean() > 0.5
    assert np.median(sides) == pytest.approx(7)


def test_tile_sides_run_along_the_half_edges() -> None:
    quads = subdivided(NAMED["torus"], levels=1)
    sides = tile_sides(quads)
    np.testing.assert_allclose(sides[quads.twins], sides, rtol=1e-12)


@pytest.mark.parametrize("name", NAMED)
def test_smaller_tiles_are_more_tiles_and_one_step_makes_four_of_one(name: str) -> None:
    mesh = sized(NAMED[name], size=80)
    counts = [len(tiled(mesh, tile_size=size).tiles) for size in (80, 30, 17, 10, 6, 3.5)]
    assert counts[0] == len(mesh.corners)
    assert counts == sorted(counts)
    assert np.log2([count / counts[0] for count in counts]) % 2 == pytest.approx(0)


@settings(max_examples=20)
@given(name=st.sampled_from(sorted(NAMED)), tile_size=st.floats(4, 40))
def test_tiles_come_out_nearest_to_what_was_asked(name: str, tile_size: float) -> None:
    mesh = sized(NAMED[name], size=100)
    quads = tiled(mesh, tile_size=tile_size)
    side = float(np.median(tile_sides(quads)))
    next_side = float(np.median(tile_sides(catmull_clark(quads).mesh)))
    assert abs(np.log2(side / tile_size)) <= abs(np.log2(next_side / tile_size)) + 0.1
    if len(quads.tiles) > len(mesh.corners):
        assert abs(np.log2(side / tile_size)) < 0.6


@settings(max_examples=20)
@given(tile_size=st.floats(3, 40), power=st.integers(-10, 10))
def test_only_the_ratio_of_body_and_tile_counts(tile_size: float, power: int) -> None:
    mesh, factor = NAMED["cube"].scaled(40), 2.0**power
    scaled = tiled(mesh.scaled(factor), tile_size=tile_size * factor)
    quads = tiled(mesh, tile_size=tile_size)
    assert (scaled.tiles == quads.tiles).all()
    np.testing.assert_allclose(scaled.points, quads.points * factor, rtol=1e-12)


@pytest.mark.parametrize("tile_size", [0.0, -3.0, 80.5, 1e9, float("nan"), float("inf")])
def test_a_tile_size_that_is_none_or_larger_than_the_body_is_an_error(tile_size: float) -> None:
    with pytest.raises(PatternError, match=f"the body, which is 80 mm long; found {re.escape(f'{tile_size:g}')} mm"):
        tiled(NAMED["cube"].scaled(40), tile_size=tile_size)


@pytest.mark.parametrize("tile_size", [0.01, 1e-9, 1e-100])
def test_more_tiles_than_memory_holds_are_an_error(tile_size: float) -> None:
    with pytest.raises(PatternError, match=r"more than 4000000; ask for a larger pattern\.tile_size"):
        tiled(NAMED["cube"].scaled(40), tile_size=tile_size)
