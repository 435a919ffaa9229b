"""Directions are unit tangents that lie as their names say."""

from __future__ import annotations

from typing import Literal

import numpy as np
import pytest
from round_tiles import round_tiles

from fabricate.config import DirectionConfig
from fabricate.design.direction_field import STEEP, tile_directions
from fabricate.mesh.torus import torus
from fabricate.surface.sizing import sized, tiled
from fabricate.surface.tile_places import TilePlaces

BALL = round_tiles(size=60)
RING = tiled(sized(torus(around=32, across=16, tube=0.45), size=100), tile_size=4)
Lines = Literal["vector", "circles", "most-curved", "least-curved"]


def directed(lines: Lines, **keys: tuple[float, float, float]) -> np.ndarray:
    return tile_directions(RING, DirectionConfig(kind="direction", lines=lines, **keys))


@pytest.mark.parametrize("lines", ["vector", "circles", "most-curved", "least-curved"])
def test_directions_are_unit_tangents(lines: Lines) -> None:
    found = directed(lines)
    length = np.linalg.norm(found, axis=1)
    assert (np.isclose(length, 1.0) | (length == 0.0)).all()
    assert (length > 0.0).mean() > 0.9
    assert np.abs((found * TilePlaces.of(RING).normal).sum(axis=1)).max() < 1e-9


def test_circles_go_round_their_axis() -> None:
    places, axis, point = TilePlaces.of(BALL), np.array([1.0, 2.0, -1.0]), np.array([3.0, 0.0, 1.0])
    field = DirectionConfig(kind="direction", lines="circles", axis=(1.0, 2.0, -1.0), point=(3.0, 0.0, 1.0))
    found = tile_directions(BALL, field)
    spokes = places.middle - point
    round_it = np.cross(axis, spokes)
    assert (found * round_it).sum(axis=1).min() > 0.0
    # in the plane of the tile's normal and of the circle
    assert np.abs(np.einsum("tj,tj->t", found, np.cross(places.normal, round_it))).max() < 1e-9 * 30 * 30


def test_circles_on_a_ball_are_level() -> None:
    found = tile_directions(BALL, DirectionConfig(kind="direction", lines="circles"))
    assert np.abs(found[:, 2]).max() < 0.12


def test_a_vector_lies_on_the_surface_as_near_to_itself_as_can_be() -> None:
    axis = np.array([0.0, 0.6, 0.8])
    found, normal = directed("vector", axis=(0.0, 3.0, 4.0)), TilePlaces.of(RING).normal
    sine = np.sqrt(1.0 - np.square(normal @ axis))
    assert (found @ axis)[sine > STEEP] == pytest.approx(sine[sine > STEEP])
    assert not found[sine < STEEP].any()


def test_a_tube_curves_most_across_and_least_along() -> None:
    x, y, _ = TilePlaces.of(RING).middle.T
    along = np.stack([-y, x, 0.0 * x], axis=1) / np.hypot(x, y)[:, None]
    assert np.abs((directed("most-curved") * along).sum(axis=1)).max() < 0.02
    assert np.abs((directed("least-curved") * along).sum(axis=1)).min() > 0.98
