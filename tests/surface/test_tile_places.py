"""Places of tiles: on the surface, and facing out of it."""

import numpy as np
import pytest

from fabricate.mesh.torus import torus
from fabricate.surface.limit import limit_vertices
from fabricate.surface.sizing import sized, tiled
from fabricate.surface.tile_places import TilePlaces

QUADS = tiled(sized(torus(around=24, across=12, tube=0.45), size=60), tile_size=3)
RING, TUBE = 30 / 1.45, 30 * 0.45 / 1.45


def test_corners_are_those_on_the_limit_surface() -> None:
    assert (TilePlaces.of(QUADS).corners == limit_vertices(QUADS)[QUADS.tiles]).all()


def test_tiles_of_a_torus_lie_on_it_and_face_out_of_its_tube() -> None:
    places = TilePlaces.of(QUADS)
    x, y, _ = places.middle.T
    core = np.stack([x, y, 0.0 * x], axis=1) * (RING / np.hypot(x, y))[:, None]
    out = places.middle - core
    assert np.linalg.norm(out, axis=1) == pytest.approx(TUBE, rel=0.05)
    assert (places.normal * out).sum(axis=1) / np.linalg.norm(out, axis=1) == pytest.approx(1.0, abs=0.01)
    assert np.linalg.norm(places.normal, axis=1) == pytest.approx(1.0)


def test_the_centre_is_that_of_the_box() -> None:
    assert TilePlaces.of(QUADS).centre == pytest.approx(np.zeros(3), abs=0.05)
