"""Cells that keep the shape: smaller where something thin would be lost, and free of crossings."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.mesh.closed import checked_closed, genus
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.prepare.dual import dual
from fabricate.prepare.fitted import fitted
from fabricate.prepare.isotropic import isotropic
from fabricate.prepare.sizing_field import SizingField
from fabricate.prepare.soundness import crossing_faces, distances, lost
from fabricate.prepare.triangle_mesh import TriangleMesh, edges, fanned


def horned_ball() -> TriangleMesh:
    """Return a ball of radius 1 with a horn on top of it, 1.5 long and about 0.2 thick, in fine triangles."""
    ball = fanned(sphere(faces="triangles", frequency=40))
    away = np.linalg.norm(ball.points[:, :2], axis=1)
    rise = np.where(ball.points[:, 2] > 0, 1.5 * np.exp(-np.square(away / 0.1)), 0.0)
    horned = TriangleMesh(ball.points + rise[:, None] * [0, 0, 1], ball.triangles)
    return isotropic(SizingField.even(horned, length=0.06), start=horned, seed=1)


HORNED = horned_ball()


def test_even_triangles_lose_the_horn() -> None:
    even = isotropic(SizingField.even(HORNED, length=0.5), start=HORNED, seed=1)
    assert lost(even.polygons, HORNED, reach=0.2).any()


@pytest.mark.parametrize("cells_of", [lambda made: made.polygons, lambda made: dual(made.polygons)])
def test_fitted_cells_keep_the_horn(cells_of: object) -> None:
    assert callable(cells_of)
    cells: PolygonMesh = fitted(HORNED, length=0.5, reach=0.2, cells_of=cells_of, seed=1)
    assert genus(checked_closed(cells)) == 0
    assert len(crossing_faces(cells)) == 0
    assert np.mean(distances(cells, HORNED.points) > 0.2) <= 0.002
    assert cells.points[:, 2].max() > 2.0


def test_cells_are_large_where_nothing_is_lost() -> None:
    cells = fitted(HORNED, length=0.5, reach=0.2, cells_of=lambda made: made.polygons, seed=1)
    made = fanned(cells)
    joined = edges(made)
    low = (made.points[joined.ends][:, :, 2] < 0).all(axis=1)
    lengths = joined.lengths(made.points)
    assert np.median(lengths[low]) == pytest.approx(0.5, rel=0.15)
    assert np.median(lengths[~low]) < np.median(lengths[low])


def test_a_ball_needs_one_fit() -> None:
    ball = fanned(sphere(faces="triangles", frequency=16))
    fits: list[TriangleMesh] = []

    def noted(made: TriangleMesh) -> PolygonMesh:
        fits.append(made)
        return made.polygons

    fitted(ball, length=0.4, reach=0.2, cells_of=noted, seed=1)
    assert len(fits) == 1
