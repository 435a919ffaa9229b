"""Curvatures are those that spheres and tori have by formula."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fabricate.config import SphereConfig
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.formats.source import source_mesh
from fabricate.mesh.torus import torus
from fabricate.surface.curvature import tile_curvatures
from fabricate.surface.sizing import sized, tiled
from fabricate.surface.tile_places import TilePlaces
from fabricate.surface.tiling import own_tiling

RING, TUBE = 50 / 1.45, 50 * 0.45 / 1.45


def ring() -> QuadMesh:
    return tiled(sized(torus(around=32, across=16, tube=0.45), size=100), tile_size=4)


def across(vectors: np.ndarray, others: np.ndarray) -> np.ndarray:
    return np.abs((vectors * others).sum(axis=1))


def test_a_torus_has_the_curvatures_of_a_torus() -> None:
    quads = ring()
    x, y, _ = TilePlaces.of(quads).middle.T
    away = np.hypot(x, y)
    along = np.stack([-y, x, 0.0 * x], axis=1) / away[:, None]
    values, directions = tile_curvatures(quads)
    assert values[:, 0] == pytest.approx(1 / TUBE, rel=0.01)
    # the normal leans from the axis by as much as the tile lies outside of the ring
    assert values[:, 1] == pytest.approx((away - RING) / TUBE / away, abs=0.02 / TUBE)
    assert across(directions[:, 0], along).max() < 0.01
    assert across(directions[:, 1], along).min() > 0.99


def test_a_ball_has_one_curvature_and_no_direction() -> None:
    mesh = source_mesh(SphereConfig(faces="hexagons"))
    quads = own_tiling(mesh, size=60, tile_size=4, levels=None, round_limit=True).quads
    values, directions = tile_curvatures(quads)
    assert np.median(values, axis=0) == pytest.approx(1 / 30, rel=0.1)
    assert (~directions.any(axis=2)).mean() > 0.6


def test_turned_and_scaled_a_surface_curves_as_before() -> None:
    quads = ring()
    turn = np.array([[0.0, -1.0, 0.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]])
    before, after = tile_curvatures(quads), tile_curvatures(replace(quads, points=2.0 * quads.points @ turn.T))
    assert 2.0 * after.values == pytest.approx(before.values)
    assert across(after.directions[:, 0], before.directions[:, 0] @ turn.T) == pytest.approx(1.0)


def test_a_hollow_is_curved_the_other_way() -> None:
    values = tile_curvatures(ring()).values
    assert (values[:, 0] > 0.0).all()
    assert (values[:, 1] < 0.0).any()


def test_tiles_without_area_count_as_flat() -> None:
    quads = ring()
    found = tile_curvatures(replace(quads, points=0.0 * quads.points))
    assert not found.values.any()
    assert not found.directions.any()
