from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import named, polyhedra

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.quad_mesh import two_coloured
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.mesh.torus import torus
from fabricate.surface.limit import LimitSurface, Samples
from fabricate.surface.sizing import MAX_LEVELS, levels_for, sized, tile_sides

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


@given(
    name=st.sampled_from(sorted(NAMED)),
    sizes=st.tuples(st.floats(0.2, 100), st.floats(0.2, 100)).map(sorted),
)
def test_smaller_tiles_need_more_levels(name: str, sizes: list[float]) -> None:
    mesh = NAMED[name].scaled(50)
    small, large = (levels_for(mesh, tile_size=size) for size in sizes)
    assert 1 <= large <= small <= MAX_LEVELS


@pytest.mark.parametrize("tile_size", [1.5, 3.0, 7.0, 12.0])
def test_tiles_come_out_nearest_to_what_was_asked(tile_size: float) -> None:
    mesh = geodesic_sphere(frequency=1).scaled(50)
    levels = levels_for(mesh, tile_size=tile_size)
    misses = [
        abs(np.log2(np.median(tile_sides(subdivided(mesh, levels=number))) / tile_size))
        for number in (levels - 1, levels, levels + 1)
        if number >= 1
    ]
    assert min(misses) == misses[-2]
    assert misses[-2] < 0.55


@given(tile_size=st.floats(0.2, 40), factor=st.floats(0.01, 100))
def test_only_the_ratio_of_body_and_tile_counts(tile_size: float, factor: float) -> None:
    mesh = NAMED["cube"].scaled(40)
    scaled = levels_for(mesh.scaled(factor), tile_size=tile_size * factor)
    assert abs(scaled - levels_for(mesh, tile_size=tile_size)) <= (0 if factor == 1 else 1)


def test_limits_of_what_can_be_asked() -> None:
    mesh = NAMED["cube"].scaled(40)
    assert levels_for(mesh, tile_size=1e6) == 1
    assert levels_for(mesh, tile_size=1e-9) == MAX_LEVELS
