"""Sides of the tiles that cells become: exact on flat regular cells, near to Catmull-Clark's on curved ones."""

from __future__ import annotations

import numpy as np
import pytest
from polyhedra import octahedron

from fabricate.duotone.catmull_clark import catmull_clark
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.prepare.dual import dual
from fabricate.prepare.remesh import EDGE_OF_TILE
from fabricate.prepare.tile_sides import tile_sides


def test_tiles_of_a_square_have_half_its_side() -> None:
    mesh = cube(divisions=3)
    assert tile_sides(mesh) == pytest.approx(np.ptp(mesh.points[:, 0]) / 6)


def test_tiles_of_an_equilateral_triangle_are_kites() -> None:
    edge = np.sqrt(2)
    assert tile_sides(octahedron()) == pytest.approx((edge / 2 + edge / np.sqrt(12)) / 2)
    assert edge / tile_sides(octahedron()).mean() == pytest.approx(EDGE_OF_TILE, rel=0.01)


@pytest.mark.parametrize("mesh", [sphere(faces="triangles", frequency=9), dual(sphere(faces="triangles", frequency=9))])
def test_tiles_of_fine_cells_are_those_of_a_subdivision(mesh: PolygonMesh) -> None:
    made = catmull_clark(mesh).mesh
    corners = made.points[made.tiles]
    subdivided = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2).mean(axis=1)
    assert tile_sides(mesh) == pytest.approx(subdivided, rel=0.05)


def test_a_triangle_and_its_dual_have_tiles_of_one_size() -> None:
    mesh = sphere(faces="triangles", frequency=9)
    assert np.median(tile_sides(dual(mesh))) == pytest.approx(np.median(tile_sides(mesh)), rel=0.03)
