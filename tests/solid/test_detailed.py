"""The cut of new cells lies on the surface that they were made for, and its parts are sound."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.prepare.triangle_mesh import TriangleMesh, fanned
from fabricate.solid.detailed import detailed_cut
from fabricate.solid.solids import solids
from fabricate.surface.sizing import sized, tiled
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.search_tree import SearchTree


@pytest.fixture(scope="module")
def bumpy() -> TriangleMesh:
    ball = geodesic_sphere(frequency=24)
    bumps = 20.0 + 0.4 * np.sin(6.0 * ball.points[:, :1]) * np.cos(5.0 * ball.points[:, 1:2])
    return fanned(ball.moved(ball.points * bumps))


def test_the_outside_has_the_bumps_and_walls_are_as_thick_as_asked(bumpy: TriangleMesh) -> None:
    quads = tiled(sized(geodesic_sphere(frequency=2), size=40.0), tile_size=5.0)
    duotone = grown_duotone(quads, tree="random", seed=1)
    surface = detailed_cut(duotone, bumpy, rings=(0.5,), tolerance=0.1, clearance=0.3)
    away = SearchTree.of(bumpy.points, bumpy.triangles).nearest(surface.points).distance
    assert away.mean() < 0.02
    assert 0.0 < np.linalg.norm(surface.base - surface.points, axis=1).max() < 0.4
    assert len(crossing_triangles(surface.points, surface.triangles)) == 0
    made = solids(surface, thickness=2.0, clearance=0.3)
    count = len(surface.points)
    under = made.spaces[1].points[count : 2 * count]
    walls = SearchTree.of(surface.points, surface.triangles).nearest(under).distance
    assert walls.min() > 1.2
    assert np.median(walls) == pytest.approx(2.0, abs=0.2)
