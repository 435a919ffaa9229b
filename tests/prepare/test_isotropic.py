"""Isotropic triangles: on the surface, even, as long as asked for, and of the same topology."""

from __future__ import annotations

import numpy as np
import pytest
from polyhedra import HANDLES, tetrahedron

from fabricate.mesh.closed import checked_closed, genus
from fabricate.mesh.cube import cube
from fabricate.mesh.sphere import sphere
from fabricate.prepare.isotropic import isotropic
from fabricate.prepare.sizing_field import SizingField
from fabricate.prepare.triangle_mesh import TriangleMesh, edges, fanned

BALL = fanned(sphere(faces="triangles", frequency=16))


def even(mesh: TriangleMesh, *, length: float, seed: int = 1) -> TriangleMesh:
    return isotropic(SizingField.even(mesh, length=length), start=mesh, seed=seed)


@pytest.mark.parametrize("length", [0.06, 0.15, 0.4])
def test_edges_on_a_ball_have_the_length_asked_for(length: float) -> None:
    made = even(BALL, length=length)
    lengths = edges(made).lengths(made.points)
    assert np.median(lengths) == pytest.approx(length, rel=0.1)
    assert np.percentile(lengths, 5) > 0.6 * length
    assert np.percentile(lengths, 95) < 1.4 * length


def test_points_lie_on_the_surface() -> None:
    made = even(BALL, length=0.3)
    facet_sag = 1 - np.cos(edges(BALL).lengths(BALL.points).max() / np.sqrt(3))
    radii = np.linalg.norm(made.points, axis=1)
    assert 1 - 1.1 * facet_sag <= radii.min() <= radii.max() <= 1 + 1e-9


@pytest.mark.parametrize("name", HANDLES)
def test_handles_stay_however_coarse(name: str) -> None:
    mesh, handles = HANDLES[name]
    triangles = fanned(mesh)
    size = float(np.ptp(mesh.points, axis=0).max())
    fine = even(triangles, length=size / 25)
    assert genus(checked_closed(fine.polygons)) == handles
    coarse = isotropic(SizingField.even(fine, length=size / 2), start=fine, seed=1)
    assert genus(checked_closed(coarse.polygons)) == handles
    assert len(coarse.triangles) < len(fine.triangles) / 4


def test_a_coarse_and_uneven_input_becomes_even() -> None:
    needle = tetrahedron().moved(tetrahedron().points * [10, 1, 1])
    made = even(fanned(needle), length=0.4)
    lengths = edges(made).lengths(made.points)
    assert np.percentile(lengths, 95) < 1.7 * np.percentile(lengths, 25)


def test_corners_of_a_cube_are_not_worn_off() -> None:
    block = fanned(cube(divisions=12))
    half = float(block.points.max())
    made = even(block, length=half / 2)
    corners = half * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    nearest = np.linalg.norm(made.points - corners[:, None], axis=2).min(axis=1)
    assert nearest.max() < half / 6


def test_triangles_without_area_do_not_stop_it() -> None:
    """Each face of a ball gets a point on one of its edges, whose triangle there has no area."""
    ball = fanned(sphere(faces="triangles", frequency=3))
    a, b, c = ball.triangles.T
    middle = len(ball.points) + np.arange(len(a))
    points = np.concatenate([ball.points, 0.5 * (ball.points[a] + ball.points[b])])
    parts = [np.stack(part, axis=1) for part in ((a, b, middle), (b, c, middle), (c, a, middle))]
    made = even(TriangleMesh(points, np.concatenate(parts)), length=0.3)
    lengths = edges(made).lengths(made.points)
    assert np.median(lengths) == pytest.approx(0.3, rel=0.15)
    assert lengths.min() > 0.05


def test_the_same_seed_gives_the_same_triangles_and_another_one_others() -> None:
    first, again, other = (even(BALL, length=0.4, seed=seed) for seed in (1, 1, 2))
    assert first.points.tobytes() == again.points.tobytes()
    assert first.triangles.tobytes() == again.triangles.tobytes()
    assert first.points.tobytes() != other.points.tobytes()


def test_edges_are_shorter_where_that_is_asked_for() -> None:
    field = SizingField.even(BALL, length=0.4)
    for _ in range(3):
        field = field.refined(BALL.points[:, 2] > 0.8)
    made = isotropic(field, start=BALL, seed=1)
    joined = edges(made)
    height, lengths = made.points[joined.ends].mean(axis=1)[:, 2], joined.lengths(made.points)
    assert np.median(lengths[height > 0.8]) == pytest.approx(0.4 * 0.6**3, rel=0.2)
    assert np.median(lengths[height < -0.5]) == pytest.approx(0.4, rel=0.2)
