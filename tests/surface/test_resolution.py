from __future__ import annotations

import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import HANDLES, bipyramid, quad_meshes, seeds, tetrahedron

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.errors import PatternError
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.mesh.torus import torus
from fabricate.surface.limit import LimitSurface, Samples
from fabricate.surface.resolution import (
    MIN_RESOLUTION,
    SHARE_WITHIN,
    WORST_FACTOR,
    chord_errors,
    resolution_for,
)
from fabricate.surface.template import tile_template

SHAPES: dict[str, tuple[PolygonMesh, int]] = {
    "sphere": (geodesic_sphere(frequency=2).scaled(40), 1),
    "tetrahedron": (tetrahedron().scaled(50), 2),
    "valence 8": (bipyramid(8).scaled(50), 2),
    "torus": (torus(around=10, across=6, tube=0.4).scaled(30), 1),
    "double torus": (HANDLES["double torus"][0].scaled(20), 1),
}
PATTERNS = {name: random_duotone(subdivided(mesh, levels=levels), seed=3) for name, (mesh, levels) in SHAPES.items()}
shapes = pytest.mark.parametrize("name", PATTERNS)


def found_for(duotone: Duotone, tolerance: float, arc: float = 0.5) -> int:
    return resolution_for(duotone, LimitSurface.of(duotone.quads), rings=(arc,), tolerance=tolerance)


def errors_of(duotone: Duotone, resolution: int, arc: float = 0.5) -> np.ndarray:
    surface = LimitSurface.of(duotone.quads)
    return np.asarray(chord_errors(duotone, surface, rings=(arc,), resolution=resolution))


def along_edges(*, arc: float, resolution: int, yellow_joined: bool, steps: int) -> np.ndarray:
    """Return parameters along every edge of a template, ends included, (e, steps + 1, 2); arcs are bent."""
    template = tile_template(rings=(arc,), resolution=resolution, yellow_joined=yellow_joined)
    t = template.triangles
    edges = np.unique(np.sort(np.concatenate([t[:, :2], t[:, 1:], t[:, [0, 2]]]), axis=1), axis=0)
    fraction = np.linspace(0, 1, steps + 1)
    begin, end = template.uv[edges].transpose(1, 0, 2)
    places: np.ndarray = begin[:, None] + fraction[:, None] * (end - begin)[:, None]
    number = {edge: k for k, edge in enumerate(map(tuple, edges.tolist()))}
    centres = ([1, 0], [0, 1]) if yellow_joined else ([0, 0], [1, 1])
    for samples, centre in zip(template.arcs[0].tolist(), centres, strict=True):
        for edge in pairwise(samples):
            first, last = sorted(edge)
            places[number[first, last]] = bent(template.uv[first], template.uv[last], centre, fraction)
    return places


def bent(begin: np.ndarray, end: np.ndarray, centre: list[int], fraction: np.ndarray) -> np.ndarray:
    """Return places on the circle round `centre` from `begin` to `end`."""
    first, last = ((place - centre) @ [1, 1j] for place in (begin, end))
    spokes = first * (last / first) ** fraction
    return np.asarray(centre + np.stack([spokes.real, spokes.imag], axis=1))


def densely_measured(duotone: Duotone, resolution: int, arc: float) -> np.ndarray:
    """Return how far the surface strays from each edge, at the worst of many points along it."""
    surface, found = LimitSurface.of(duotone.quads), []
    for kind in (False, True):
        tiles = np.flatnonzero(duotone.joined == kind)
        uv = along_edges(arc=arc, resolution=resolution, yellow_joined=kind, steps=10)
        rows = np.arange(len(tiles) * uv.size // 2).reshape(len(tiles), -1)
        operator = surface.operator([Samples(tiles, uv.reshape(-1, 2), rows)], size=rows.size)
        places = operator.positions(surface.control).reshape(-1, uv.shape[1], 3)
        chord = places[:, -1:] - places[:, :1]
        along = np.einsum("esk,elk->es", places - places[:, :1], chord) / np.square(chord).sum(axis=2)
        foot = places[:, :1] + along[..., None] * chord
        found.append(np.linalg.norm(places - foot, axis=2).max(axis=1))
    return np.concatenate(found)


@shapes
@pytest.mark.parametrize(("tolerance", "arc"), [(0.3, 0.5), (0.1, 0.4), (0.05, 0.6)])
def test_error_is_within_the_tolerance_all_along_the_edges(name: str, tolerance: float, arc: float) -> None:
    duotone = PATTERNS[name]
    errors = densely_measured(duotone, found_for(duotone, tolerance, arc), arc)
    assert np.mean(errors <= 1.1 * tolerance) >= SHARE_WITHIN
    assert errors.max() <= 1.1 * WORST_FACTOR * tolerance


@shapes
def test_measured_errors_are_those_of_a_dense_measurement(name: str) -> None:
    quick, dense = errors_of(PATTERNS[name], 4), densely_measured(PATTERNS[name], 4, 0.5)
    assert len(quick) == len(dense)
    assert (quick <= dense + 1e-12).all()
    assert np.quantile(dense, 0.99) < 1.15 * np.quantile(quick, 0.99)


@shapes
def test_a_coarser_resolution_would_not_do(name: str) -> None:
    for tolerance in (0.3, 0.1, 0.05):
        resolution = found_for(PATTERNS[name], tolerance)
        if resolution > MIN_RESOLUTION:
            errors = errors_of(PATTERNS[name], resolution - 1)
            within = np.quantile(errors, SHARE_WITHIN) <= tolerance
            assert not within or errors.max() > WORST_FACTOR * tolerance


@shapes
def test_a_finer_tolerance_needs_a_finer_resolution(name: str) -> None:
    found = [found_for(PATTERNS[name], tolerance) for tolerance in (5.0, 1.0, 0.5, 0.2, 0.1, 0.05)]
    assert found[0] == MIN_RESOLUTION
    assert found == sorted(found)
    assert found[-1] > MIN_RESOLUTION


@shapes
def test_errors_fall_with_the_square_of_the_resolution(name: str) -> None:
    coarse, fine = (np.median(errors_of(PATTERNS[name], resolution)) for resolution in (6, 12))
    assert np.log2(coarse / fine) == pytest.approx(2, abs=0.35)


@settings(max_examples=15)
@given(quads=quad_meshes(), seed=seeds, power=st.integers(-8, 8))
def test_errors_grow_with_the_body(quads: QuadMesh, seed: int, power: int) -> None:
    duotone = random_duotone(quads, seed=seed)
    factor = 2.0**power
    larger = Duotone(replace(quads, points=factor * quads.points), duotone.joined)
    expected = factor * errors_of(duotone, 3)
    np.testing.assert_allclose(errors_of(larger, 3), expected, rtol=1e-9, atol=factor * 1e-13)


def test_flat_squares_have_errors_on_their_arcs_only() -> None:
    side, n = 5.0, 5
    quads = two_coloured(cube(divisions=12).scaled(6 * side))
    inner = np.sum(np.abs(quads.points[quads.tiles]).max(axis=1) < 6 * side - 1.01 * side, axis=1) == 2
    sagitta = 0.5 * side * (1 - np.cos(np.pi / 4 / n))
    errors = errors_of(random_duotone(quads, seed=1), n)
    assert np.isclose(errors, sagitta, rtol=1e-9).sum() >= 2 * n * inner.sum()
    assert np.isclose(errors, 0, atol=1e-12).sum() > 0.5 * len(errors)


@shapes
@pytest.mark.parametrize("tolerance", [1e-6, 1e-9])
def test_an_absurd_tolerance_is_an_error_that_says_what_it_would_take(name: str, tolerance: float) -> None:
    with pytest.raises(PatternError, match=r"ask for a larger solid\.tolerance") as caught:
        found_for(PATTERNS[name], tolerance)
    triangles = re.search(rf"a tolerance of {tolerance:g} mm needs (\d+) triangles", str(caught.value))
    assert triangles is not None
    assert int(triangles[1]) > 4_000_000
