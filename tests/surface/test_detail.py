"""Detail: on the target, crossing-free, unfolded, close to the smooth surface where the target says nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import on_sphere, seeds

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.errors import SolidError
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.torus import torus
from fabricate.surface.cut import CutSurface, cut
from fabricate.surface.detail import Carried, carried
from fabricate.surface.deviation import deviation
from fabricate.surface.embedding import OPEN, Embedding
from fabricate.surface.limit import LimitSurface
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.normals import area_vectors, vertex_normals
from fabricate.triangles.search_tree import SearchTree

RADIUS = 20.0


@dataclass(frozen=True, eq=False)
class Surface:
    points: np.ndarray
    triangles: np.ndarray

    @classmethod
    def of(cls, mesh: trimesh.Trimesh) -> Surface:
        return cls(np.array(mesh.vertices), np.array(mesh.faces))

    @property
    def normals(self) -> np.ndarray:
        return np.asarray(vertex_normals(self.points, self.triangles))


@cache
def ball(subdivisions: int) -> Surface:
    return Surface.of(trimesh.creation.icosphere(subdivisions=subdivisions, radius=RADIUS))


def cut_of(mesh: PolygonMesh, *, levels: int, resolution: int = 3) -> CutSurface:
    quads = subdivided(mesh, levels=levels)
    return cut(random_duotone(quads, seed=1), LimitSurface.of(quads), rings=(0.5,), resolution=resolution)


def carried_onto(smooth: Surface | CutSurface, onto: Surface) -> Carried:
    return carried(smooth.points, smooth.normals, smooth.triangles, onto.points, onto.triangles)


def with_radii(surface: Surface, factor: np.ndarray) -> Surface:
    return Surface(surface.points * factor[:, None], surface.triangles)


def bumpy(surface: Surface, seed: int, height: float) -> Surface:
    """Return a sphere with waves of random directions on it."""
    random = np.random.default_rng(seed)
    waves = np.sin(surface.points / RADIUS @ random.normal(scale=4.0, size=(3, 6)) + random.uniform(0, 6, 6))
    return with_radii(surface, 1.0 + height * waves.mean(axis=1))


def spiked(surface: Surface, direction: np.ndarray, *, height: float, width: float) -> Surface:
    away = np.linalg.norm(surface.points / RADIUS - direction, axis=1)
    return with_radii(surface, 1.0 + height * np.exp(-((away / width) ** 2)))


def assert_sound(points: np.ndarray, triangles: np.ndarray) -> None:
    """Nothing crosses, folds over or has lost its area, as float32 holds it."""
    held = points.astype(np.float32)
    assert (held == points).all()
    assert len(crossing_triangles(points, triangles)) == 0
    assert area_vectors(held.astype(np.float64), triangles).any(axis=1).all()
    assert not (Embedding.of(triangles, count=len(points)).openness(points) < OPEN).any()


def test_a_round_cage_lands_on_the_sphere() -> None:
    """The limit of a cube's cage is no sphere: off by 1 mm before, and by no more than facets make after."""
    smooth, onto = cut_of(cube(divisions=1).scaled(1.4 * RADIUS), levels=3), ball(5)
    made = carried_onto(smooth, onto)
    assert np.abs(np.linalg.norm(smooth.points, axis=1) - RADIUS).max() > 1.0
    radius = np.linalg.norm(made.points, axis=1)
    inside = np.linalg.norm(onto.points[onto.triangles].mean(axis=1), axis=1).min()
    assert radius.min() > inside - 1e-4
    assert radius.max() < RADIUS + 1e-4
    assert_sound(made.points, smooth.triangles)


@given(seed=seeds)
@settings(max_examples=5)
def test_bumps_are_taken_on(seed: int) -> None:
    onto = bumpy(ball(5), seed, 0.1)
    smooth = ball(4)
    made = carried_onto(smooth, onto)
    assert_sound(made.points, smooth.triangles)
    assert SearchTree.of(onto.points, onto.triangles).nearest(made.points).distance.max() < 1e-4 * RADIUS
    before = deviation(smooth.points, smooth.triangles, onto.points, onto.triangles)
    after = deviation(made.points, smooth.triangles, onto.points, onto.triangles)
    assert after.mean < 0.1 * before.mean


def test_what_is_there_already_stays() -> None:
    onto = bumpy(ball(4), 5, 0.05)
    made = carried_onto(onto, onto)
    np.testing.assert_allclose(made.points, onto.points, atol=1e-4)


def test_a_torus_stays_a_torus() -> None:
    smooth = cut_of(torus(around=10, across=6, tube=0.4).scaled(20.0), levels=2)
    exact = trimesh.creation.torus(20.0, 8.0, major_sections=96, minor_sections=48)
    onto = Surface.of(exact)
    made = carried_onto(smooth, onto)
    assert_sound(made.points, smooth.triangles)
    after = deviation(made.points, smooth.triangles, onto.points, onto.triangles)
    assert after.max < 0.1
    volume = trimesh.Trimesh(made.points, smooth.triangles, process=False).volume
    assert volume == pytest.approx(exact.volume, rel=2e-3)


def test_a_spike_that_the_smooth_surface_lacks_is_filled() -> None:
    """Rays from most of the sphere miss a finger as long as half the radius; the sheet stretches into it."""
    direction = np.array([0.6, 0.0, 0.8])
    onto, smooth = spiked(ball(6), direction, height=0.5, width=0.15), ball(5)
    made = carried_onto(smooth, onto)
    assert_sound(made.points, smooth.triangles)
    after = deviation(made.points, smooth.triangles, onto.points, onto.triangles)
    assert after.p999 < 0.05 * RADIUS
    assert (made.points @ direction).max() > 1.4 * RADIUS


def test_what_is_missed_comes_nearer_in_more_rounds(monkeypatch: pytest.MonkeyPatch) -> None:
    onto, smooth = spiked(ball(6), np.array([0.6, 0.0, 0.8]), height=0.8, width=0.12), ball(5)
    after = carried_onto(smooth, onto)
    monkeypatch.setattr("fabricate.surface.detail.LATE", ())
    before = carried_onto(smooth, onto)
    far, near = (deviation(made.points, smooth.triangles, onto.points, onto.triangles).p999 for made in (before, after))
    assert near < 0.95 * far
    assert_sound(after.points, smooth.triangles)


def test_where_nothing_is_missed_there_are_no_more_rounds(monkeypatch: pytest.MonkeyPatch) -> None:
    onto, smooth = bumpy(ball(4), seed=1, height=0.1), ball(4)
    before = carried_onto(smooth, onto)
    monkeypatch.setattr("fabricate.surface.detail.LATE", (20, 20))
    assert (carried_onto(smooth, onto).points == before.points).all()


def test_a_deep_narrow_pit_is_followed_without_crossing() -> None:
    onto = spiked(ball(6), np.array([0.0, 0.6, 0.8]), height=-0.5, width=0.15)
    smooth = ball(5)
    made = carried_onto(smooth, onto)
    assert_sound(made.points, smooth.triangles)
    assert np.linalg.norm(made.points, axis=1).min() < 0.7 * RADIUS


def rough_target(seed: int) -> Surface:
    """Return a sphere as rough as its triangles are small, so that nearest places and rays cross each other."""
    fine = ball(4)
    random = np.random.default_rng(seed)
    return with_radii(fine, 1.0 + 0.3 * random.random(len(fine.points)))


@given(seed=seeds)
@settings(max_examples=4)
def test_where_plain_projection_crosses_nothing_does(seed: int) -> None:
    onto, smooth = rough_target(seed), ball(5)
    plain = SearchTree.of(onto.points, onto.triangles).nearest(smooth.points).point
    assert len(crossing_triangles(plain, smooth.triangles)) > 0
    assert_sound(carried_onto(smooth, onto).points, smooth.triangles)


def test_two_sheets_close_to_each_other_stay_apart() -> None:
    """A plate whose smooth version is much thicker: each side lands on its own side of it."""
    sphere = ball(5)
    thin, thick = (Surface(sphere.points * [1.0, 1.0, share], sphere.triangles) for share in (0.03, 0.3))
    made = carried_onto(thick, thin)
    assert len(crossing_triangles(made.points, thick.triangles)) == 0
    flat = np.linalg.norm(made.points[:, :2], axis=1) < 0.9 * RADIUS
    assert (made.points[flat, 2] * sphere.points[flat, 2] >= 0).all()
    assert deviation(made.points, thick.triangles, thin.points, thin.triangles).p999 < 0.02 * RADIUS


def test_a_tangle_in_the_smooth_surface_is_undone() -> None:
    smooth = ball(4)
    points = smooth.points.copy()
    points[100] *= 0.6
    points[smooth.triangles[(smooth.triangles == 100).any(axis=1)][0]] *= -0.2
    assert len(crossing_triangles(points, smooth.triangles)) > 0
    made = carried(points, smooth.normals, smooth.triangles, smooth.points, smooth.triangles)
    assert_sound(made.points, smooth.triangles)


def test_a_smooth_surface_that_is_lost_is_refused_with_its_place() -> None:
    smooth = ball(2)
    flat = np.tile([[5.0, 0.0, 0.0]], (len(smooth.points), 1))
    with pytest.raises(SolidError, match=r"\(5\.00, 0\.00, 0\.00\) mm"):
        carried(flat, smooth.normals, smooth.triangles, smooth.points, smooth.triangles)


@given(seed=seeds, smoothing=st.sampled_from([1.0, 3.0]))
@settings(max_examples=4)
def test_the_base_is_smooth_and_close(seed: int, smoothing: float) -> None:
    """Fine relief is taken out of the base: it lies nearer to the smooth surface than the relief is high."""
    smooth = ball(5)
    random = np.random.default_rng(seed)
    onto = with_radii(smooth, 1.0 + 0.02 * (random.random(len(smooth.points)) - 0.5))
    made = carried(smooth.points, smooth.normals, smooth.triangles, onto.points, onto.triangles, smoothing=smoothing)
    relief = np.abs(np.linalg.norm(made.points, axis=1) - RADIUS)
    left = np.abs(np.linalg.norm(made.base, axis=1) - RADIUS)
    assert left.std() < 0.5 * relief.std()
    assert left.max() <= relief.max() + 1e-6
    np.testing.assert_allclose(np.linalg.norm(made.base_normals, axis=1), 1)
    facing = np.einsum("ij,ij->i", made.base_normals, on_sphere(made.base))
    assert facing.min() > 0.9
    assert_sound(made.base, smooth.triangles)


def test_broad_shapes_are_in_the_base() -> None:
    """A base under a larger sphere is as large as it."""
    smooth = with_radii(ball(4), np.full(len(ball(4).points), 0.9))
    made = carried_onto(smooth, ball(5))
    np.testing.assert_allclose(np.linalg.norm(made.base, axis=1), RADIUS, rtol=2e-3)


def test_the_same_input_gives_the_same_bytes() -> None:
    onto = bumpy(ball(4), 1, 0.1)
    first, second = carried_onto(ball(3), onto), carried_onto(ball(3), onto)
    assert first.points.tobytes() == second.points.tobytes()
    assert first.base.tobytes() == second.base.tobytes()


def test_results_are_read_only_and_inputs_are_left_alone() -> None:
    smooth, onto = ball(3), bumpy(ball(4), 1, 0.1)
    before = smooth.points.copy()
    made = carried_onto(smooth, onto)
    assert (smooth.points == before).all()
    with pytest.raises(ValueError, match="read-only"):
        made.points[0] = 0.0
