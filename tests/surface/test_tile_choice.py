"""Which tiles are chosen: own cells as long as they do, coarser ones for wide necks, new ones as a last resort."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from crowding import crowded_cage

from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.crease import creased
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.mesh.torus import torus
from fabricate.prepare.remesh import Cells, Remeshed
from fabricate.surface.neck import coarse_necks
from fabricate.surface.sizing import typical_side
from fabricate.surface.tile_choice import TileWish, chosen_tiling, tile_scale
from fabricate.surface.tiling import Tiling

GROW = partial(grown_duotone, tree="random", seed=3)
RING = torus(around=12, across=6, tube=0.45)
WISH = TileWish(
    size=100.0,
    tile_size=5.0,
    levels=None,
    cells="auto",
    neck=0.1,
    depth=0.0,
    clearance=0.05,
    thinnest=0.1,
    resized=True,
    rings=(0.5,),
    seed=0,
    crease=None,
    cage=True,
    round_limit=False,
)


@pytest.fixture(autouse=True)
def asked(monkeypatch: pytest.MonkeyPatch) -> list[tuple[Cells, int]]:
    """Make new cells of any kind at once, and write down which were asked for and of how many faces."""
    calls: list[tuple[Cells, int]] = []

    def remeshed(mesh: PolygonMesh, *, cells: Cells, **_: object) -> Remeshed:
        calls.append((cells, len(mesh.offsets) - 1))
        return Remeshed(RING.scaled(50.0), ("made new",))

    monkeypatch.setattr("fabricate.surface.tiling.remeshed", remeshed)
    return calls


def test_the_scale_is_that_of_the_tiles(asked: list[tuple[Cells, int]]) -> None:
    small = RING.scaled(0.01)
    assert tile_scale(small, WISH) == pytest.approx(100.0 * tile_scale(RING, WISH))
    own = chosen(small, WISH)
    cage = small.scaled(tile_scale(small, WISH, own))
    assert tile_scale(cage, WISH) == pytest.approx(1.0)
    scan = geodesic_sphere(frequency=4)
    wish = replace(WISH, cage=False, cells="quads")
    assert tile_scale(scan, wish, chosen(scan, wish)) == pytest.approx(50.0, rel=0.01)
    assert tile_scale(scan, wish) > 50.5  # the smooth surface of its own cells is smaller than the scan
    assert asked


def chosen(mesh: PolygonMesh, wish: TileWish) -> Tiling:
    return chosen_tiling(mesh, wish, grow=GROW, progress=lambda _: None)


def test_own_cells_are_taken_when_nothing_speaks_against_them(asked: list[tuple[Cells, int]]) -> None:
    tiling = chosen(RING, WISH)
    assert typical_side(tiling.quads) == pytest.approx(5.0, rel=0.42)
    assert (tiling.surface, tiling.notes, asked) == (None, (), [])


def test_levels_count(asked: list[tuple[Cells, int]]) -> None:
    assert len(chosen(RING, replace(WISH, tile_size=None, levels=2)).quads.tiles) == 72 * 16
    assert not asked


def test_narrow_necks_ask_for_coarser_tiles_and_say_so() -> None:
    fine = chosen(RING, WISH)
    narrowest = coarse_necks(GROW(fine.quads), rings=(0.5,)).min()
    coarse = chosen(RING, replace(WISH, neck=1.5 * narrowest))
    assert typical_side(coarse.quads) > 1.5 * typical_side(fine.quads)
    assert coarse_necks(GROW(coarse.quads), rings=(0.5,)).min() >= 1.5 * narrowest
    assert "larger" in coarse.notes[0]


def test_necks_wide_enough_change_nothing() -> None:
    fine = chosen(RING, WISH)
    narrowest = coarse_necks(GROW(fine.quads), rings=(0.5,)).min()
    again = chosen(RING, replace(WISH, neck=0.99 * narrowest))
    assert (again.quads.points == fine.quads.points).all()
    assert again.notes == ()


@pytest.mark.parametrize(("cells", "new"), [("auto", True), ("as-is", False)])
def test_necks_that_no_division_has_ask_for_new_cells(cells: str, new: bool, asked: list[tuple[Cells, int]]) -> None:
    tiling = chosen(RING, replace(WISH, cells=cells, neck=30.0))  # type: ignore[arg-type]
    assert (tiling.surface is not None) == new
    assert [kind for kind, _ in asked] == ["quads"] * new
    assert any("necks" in note for note in tiling.notes) == new


@pytest.mark.parametrize(("cells", "new"), [("auto", True), ("as-is", False)])
def test_cells_of_the_size_asked_for_without_room_for_the_clearance_ask_for_new_ones(
    cells: str, new: bool, asked: list[tuple[Cells, int]]
) -> None:
    wish = replace(WISH, resized=False, neck=30.0, cells=cells)  # type: ignore[arg-type]
    necks = coarse_necks(GROW(chosen(RING, wish).quads), rings=(0.5,))
    assert not asked
    few, many = np.quantile(necks, [0.05, 0.2])
    assert chosen(RING, replace(wish, clearance=few)).surface is None
    tiling = chosen(RING, replace(wish, clearance=many))
    assert [kind for kind, _ in asked] == ["quads"] * new
    assert any("clearance" in note for note in tiling.notes) == new


CROWDED = replace(WISH, size=60.0, tile_size=4.0, neck=0.8, cage=False)


def test_a_cage_slides_until_its_necks_are_wide(asked: list[tuple[Cells, int]]) -> None:
    tiling = chosen(crowded_cage(), CROWDED)
    assert coarse_necks(GROW(tiling.quads), rings=(0.5,)).min() >= CROWDED.neck
    assert tiling.surface is not None
    assert tiling.notes == ("the mesh's own cells slid over its surface until their necks were 0.8 mm wide",)
    assert not asked


@pytest.mark.parametrize("sound", [True, False])
def test_nearly_all_necks_wide_will_do_where_new_quads_are_not_as_asked_for(
    sound: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("fabricate.surface.tile_choice.widened", lambda quads, *_, **__: quads)
    if sound:
        monkeypatch.setattr("fabricate.surface.tiling.remeshed", lambda *_, **__: Remeshed(RING.scaled(50.0), ()))
    tiling = chosen(crowded_cage(), CROWDED)
    assert ("new quads" if sound else "but for") in tiling.notes[0]


@pytest.mark.parametrize("cells", ["quads", "triangles", "hexagons"])
def test_new_cells_are_made_when_they_are_asked_for(cells: Cells, asked: list[tuple[Cells, int]]) -> None:
    assert chosen(RING, replace(WISH, cells=cells)).notes == ("made new",)
    assert [kind for kind, _ in asked] == [cells]


def test_fine_triangles_get_new_quads_on_themselves(asked: list[tuple[Cells, int]]) -> None:
    scan = geodesic_sphere(frequency=12)
    chosen(scan, replace(WISH, tile_size=20.0, cage=False))
    assert asked == [("quads", len(scan.offsets) - 1)]


@pytest.mark.parametrize(("cage", "cells", "smooth"), [(True, "quads", True), (False, "quads", False)])
def test_a_cage_gets_new_cells_on_its_smooth_surface(
    cage: bool,
    cells: Cells,
    smooth: bool,
    asked: list[tuple[Cells, int]],
) -> None:
    tiling = chosen(cube(divisions=2), replace(WISH, cage=cage, cells=cells))
    assert tiling.surface is not None
    reach = np.linalg.norm(tiling.surface.points, axis=1).max()
    assert (reach < 0.8 * 50.0 * np.sqrt(3.0)) == smooth
    assert (asked[0][1] > 1000) == smooth


@pytest.mark.parametrize(
    ("cells", "kind"), [("quads", "triangles"), ("triangles", "triangles"), ("hexagons", "hexagons")]
)
def test_a_body_with_creases_gets_new_triangles_and_is_told_when_that_is_not_what_was_asked(
    cells: Cells, kind: Cells, asked: list[tuple[Cells, int]]
) -> None:
    body = creased(cube(divisions=2), angle=40.0)
    tiling = chosen(body, replace(WISH, cells=cells, crease=40.0, cage=False))
    assert {made for made, _ in asked} == {kind}
    assert any("sharp edges" in note for note in tiling.notes) == (cells != "triangles")


def test_larger_tiles_are_made_while_few_necks_are_narrow(monkeypatch: pytest.MonkeyPatch) -> None:
    sides: list[float] = []
    ball = geodesic_sphere(frequency=4).scaled(50.0)

    def remeshed(*_: object, tile_size: float, **__: object) -> Remeshed:
        sides.append(tile_size)
        return Remeshed(ball, ())

    shares = iter([0.04, 0.03, 0.01])
    monkeypatch.setattr("fabricate.surface.tiling.remeshed", remeshed)
    monkeypatch.setattr("fabricate.surface.tile_choice.widened", lambda quads, *_, **__: quads)
    monkeypatch.setattr("fabricate.surface.tile_choice._narrow_share", lambda *_: next(shares))
    wish = replace(WISH, cells="triangles", cage=False)
    tiling = chosen(ball, wish)
    assert sides == pytest.approx([5.0, 5.75, 6.5])
    assert "6.5 mm" in tiling.notes[0]  # 3 % of narrow necks are not enough fewer than 4 %
    shares = iter([0.2])
    assert chosen(ball, wish).notes == ()
    shares = iter([0.04])
    assert chosen(ball, replace(wish, resized=False)).notes == ()


def test_long_triangles_are_no_cells_to_keep(asked: list[tuple[Cells, int]]) -> None:
    ball = geodesic_sphere(frequency=1)
    wish = replace(WISH, cage=False, tile_size=20.0)
    assert chosen(ball, wish).surface is None
    long = ball.moved(ball.points * [1.0, 1.0, 6.0])
    assert chosen(long, wish).surface is not None
    assert asked
