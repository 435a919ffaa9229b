"""Designs: the duotone that a wish asks for."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import shortest_path

from fabricate.config import DirectionConfig, HeightConfig, LockConfig, OptimiseConfig, SideConfig
from fabricate.design.curve_wish import CurveWish
from fabricate.design.designed import designed, grown
from fabricate.design.field import FieldWish
from fabricate.design.tips import tip_count
from fabricate.duotone.certificate import certified
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.spanning_tree import Tree
from fabricate.errors import PatternError
from fabricate.mesh.pierced import double_torus
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.surface.limit import limit_vertices
from fabricate.surface.sizing import sized, tiled

WISH = CurveWish(tree="random", seed=3, rings=(0.5,), neck=1.0)
CIRCLES = FieldWish(DirectionConfig(kind="direction", lines="circles"))
LOCKS = (
    LockConfig(joined="yellow", tiles=(1, 2)),
    LockConfig(joined="blue", hold="most", side=SideConfig(point=(0.0, 0.0, 0.0), normal=(0.0, 0.0, 1.0))),
)


def ball() -> QuadMesh:
    return tiled(sized(geodesic_sphere(frequency=2), size=50), tile_size=5)


def corridor_lengths(duotone: Duotone, root: int) -> np.ndarray:
    """Tiles between the root and each point of the yellow tree."""
    ends = duotone.quads.tiles[duotone.joined][:, [0, 2]].T
    count = len(duotone.quads.points)
    tree = coo_array((np.ones(ends.shape[1]), (ends[0], ends[1])), shape=(count, count))
    return np.asarray(shortest_path(tree, directed=False, indices=root))[duotone.quads.yellow]


@pytest.mark.parametrize("tree", ["random", "uniform", "breadth-first", "depth-first"])
def test_a_design_is_one_curve(tree: Tree) -> None:
    wish = replace(WISH, tree=tree)
    duotone = designed(ball(), wish).duotone
    assert certified(duotone).holds
    assert np.array_equal(duotone.joined, grown(ball(), wish).joined)


def test_corridors_radiate_from_the_root() -> None:
    quads = ball()
    duotone = grown(quads, replace(WISH, tree="breadth-first", root=(0.0, 0.0, 25.0)))
    top = int(np.where(quads.yellow, limit_vertices(quads)[:, 2], -np.inf).argmax())
    every = coo_array((np.ones(len(quads.tiles)), tuple(quads.tiles[:, [0, 2]].T)), shape=2 * (len(quads.points),))
    shortest = np.asarray(shortest_path(every, directed=False, unweighted=True, indices=top))[quads.yellow]
    assert np.array_equal(corridor_lengths(duotone, top), shortest)


def test_another_root_gives_another_tree() -> None:
    roots = [(0.0, 0.0, 25.0), (25.0, 0.0, 0.0)]
    first, second = (grown(ball(), replace(WISH, tree="depth-first", root=root)).joined for root in roots)
    assert not np.array_equal(first, second)


@pytest.mark.parametrize("tree", ["random", "uniform", "breadth-first", "depth-first", "field"])
def test_every_tree_keeps_to_locks(tree: Tree | Literal["field"]) -> None:
    wish = replace(WISH, tree=tree, field=CIRCLES if tree == "field" else None, locks=LOCKS)
    design = designed(ball(), wish)
    assert design.locks is not None
    assert certified(design.duotone).holds
    assert design.duotone.joined[design.locks.yellow].all()
    assert not design.duotone.joined[design.locks.blue].any()
    assert design.locks.yellow[[1, 2]].all()
    assert certified(grown(ball(), wish)).holds


def test_alignment_is_measured_with_a_field_of_directions() -> None:
    design = designed(ball(), replace(WISH, tree="field", field=CIRCLES))
    assert design.alignment is not None
    assert design.alignment > 0.85
    height = FieldWish(HeightConfig(kind="height"))
    assert designed(ball(), replace(WISH, tree="field", field=height)).alignment is None


def test_corridors_lead_down_a_field() -> None:
    quads = ball()
    joined = designed(quads, replace(WISH, tree="field", field=FieldWish(HeightConfig(kind="height")))).duotone.joined
    ends = limit_vertices(quads)[quads.tiles][:, [0, 2], 2]
    assert np.abs(np.diff(ends[joined])).mean() > 1.3 * np.abs(np.diff(ends[~joined])).mean()


def test_ties_of_a_field_are_drawn_from_the_seed() -> None:
    flat = FieldWish(HeightConfig(kind="height", jitter=1.0))
    first, again, other = (designed(ball(), replace(WISH, tree="field", field=flat, seed=k)).duotone for k in (1, 1, 2))
    assert (first.joined == again.joined).all()
    assert (first.joined != other.joined).any()


def test_a_field_is_missed() -> None:
    with pytest.raises(PatternError, match="needs a field to follow, found none"):
        designed(ball(), replace(WISH, tree="field"))


def figure_eight() -> QuadMesh:
    return tiled(sized(double_torus(), size=60), tile_size=5)


def test_yellow_gets_the_handles_asked_for_and_locked_tiles_stay() -> None:
    quads = figure_eight()
    locks = (LockConfig(joined="blue", near=(20.0, 0.0, 0.0), within=8.0, hold="most"),)
    for handles in (0, 1, 2):
        found = designed(quads, replace(WISH, handles=handles, locks=locks, optimise=OptimiseConfig(tips=1, flips=200)))
        assert certified(found.duotone).holds
        assert certified(found.duotone).yellow.handles == handles
        assert found.locks is not None
        assert found.locks.blue.any()
        assert not found.duotone.joined[found.locks.blue].any()
        assert found.duotone.joined[found.locks.yellow].all()


def test_handles_beyond_the_genus_are_refused() -> None:
    with pytest.raises(PatternError, match="genus 2"):
        designed(figure_eight(), replace(WISH, handles=3))


def test_what_counts_gets_better_and_is_reported() -> None:
    quads = ball()
    plain = designed(quads, WISH)
    assert (dict(plain.objectives), plain.notes) == ({}, ())
    told: list[str] = []
    found = designed(quads, replace(WISH, optimise=OptimiseConfig(tips=1, flips=500)), progress=told.append)
    assert found.objectives["tips"].before == tip_count(plain.duotone)
    assert found.objectives["tips"].after == tip_count(found.duotone) < tip_count(plain.duotone)
    assert len(told) == 10


@pytest.mark.parametrize("corridors", ["along", "across"])
def test_alignment_follows_the_field(corridors: Literal["along", "across"]) -> None:
    field = FieldWish(DirectionConfig(kind="direction", lines="circles", corridors=corridors))
    wish = replace(WISH, field=field, optimise=OptimiseConfig(alignment=1, flips=2000))
    change = designed(ball(), wish).objectives["alignment"]
    assert change.after - change.before > 0.1 if corridors == "along" else change.before - change.after > 0.1
    tree = designed(ball(), replace(WISH, tree="field", field=field)).alignment
    assert change.after == pytest.approx(tree, abs=0.005)


def test_time_that_is_up_is_noted() -> None:
    found = designed(ball(), replace(WISH, optimise=OptimiseConfig(tips=1, seconds=1e-6)))
    assert found.notes[0].startswith("optimising ended after 0 of 20000 flips")
