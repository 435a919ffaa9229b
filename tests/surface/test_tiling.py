"""Tiles: of a body's own cells, or of new ones that lie on its surface."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fabricate.errors import PatternError
from fabricate.mesh.closed import genus
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus
from fabricate.prepare.remesh import Cells, Remeshed
from fabricate.prepare.store import Store
from fabricate.surface.limit import limit_vertices
from fabricate.surface.sizing import tile_sides
from fabricate.surface.tiling import input_surface, new_tiling, own_tiling, smooth_surface

RING = torus(around=12, across=6, tube=0.45)


def test_own_cells_are_halved_or_counted() -> None:
    by_size = own_tiling(RING, size=60.0, tile_size=6.0, levels=None, round_limit=False)
    by_levels = own_tiling(RING, size=60.0, tile_size=None, levels=2, round_limit=False)
    assert 6.0 / 1.5 < np.median(tile_sides(by_size.quads)) < 6.0 * 1.5
    assert len(by_levels.quads.tiles) == 72 * 4**2
    assert by_size.surface is None
    assert by_size.quads.genus == by_levels.quads.genus == 1


def test_levels_beyond_memory_are_refused_at_once() -> None:
    with pytest.raises(PatternError, match="levels"):
        own_tiling(RING, size=60.0, tile_size=None, levels=12, round_limit=False)


def test_a_round_limit_is_round() -> None:
    tiles = own_tiling(sphere(faces="hexagons", frequency=1), size=60.0, tile_size=4.0, levels=None, round_limit=True)
    radius = np.linalg.norm(limit_vertices(tiles.quads), axis=1)
    assert np.ptp(radius) < 0.01 * 30.0


def test_the_input_is_scaled_to_its_size() -> None:
    surface = input_surface(RING, size=60.0)
    assert np.ptp(surface.points, axis=0).max() == pytest.approx(60.0)
    assert genus(surface.polygons) == 1


def test_the_smooth_surface_of_a_cage_is_fine_and_as_large_as_asked() -> None:
    surface = smooth_surface(RING, size=60.0, round_limit=False)
    assert np.ptp(surface.points, axis=0).max() == pytest.approx(60.0, rel=1e-3)
    assert len(surface.triangles) > 20_000


@pytest.mark.slow
@pytest.mark.parametrize("cells", ["quads", "triangles", "hexagons"])
def test_new_cells_give_tiles_of_the_size_asked_for_on_the_surface(cells: Cells) -> None:
    surface = smooth_surface(RING, size=60.0, round_limit=False)
    made = new_tiling(surface, cells=cells, tile_size=5.0, seed=0, progress=lambda _: None)
    sides = tile_sides(made.quads).reshape(-1, 4).mean(axis=1)
    assert np.median(sides) == pytest.approx(5.0, rel=0.15)
    assert made.quads.genus == 1
    assert np.ptp(limit_vertices(made.quads), axis=0) == pytest.approx(np.ptp(surface.points, axis=0), abs=1.0)


def test_cells_that_were_made_before_are_not_made_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    surface, calls = input_surface(RING, size=60.0), []

    def remeshed(mesh: PolygonMesh, *, cells: Cells, tile_size: float, seed: int, **_: object) -> Remeshed:
        calls.append((cells, tile_size, seed))
        return Remeshed(mesh, ("a note",))

    monkeypatch.setattr("fabricate.surface.tiling.remeshed", remeshed)
    monkeypatch.setattr("fabricate.prepare.store.WORTH_KEEPING", -1.0)
    asked: list[tuple[Cells, float, int]] = [
        ("quads", 5.0, 0),
        ("quads", 5.0, 1),
        ("quads", 6.0, 0),
        ("hexagons", 5.0, 0),
    ]
    for cells, tile_size, seed in asked + asked:
        made = new_tiling(
            surface, cells=cells, tile_size=tile_size, seed=seed, progress=lambda _: None, store=Store(tmp_path)
        )
        assert made.notes == ("a note",)
        assert made.quads.genus == 1
    assert calls == asked
