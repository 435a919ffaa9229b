"""Layers of walls: nowhere too near each other, nowhere far too wide apart, and drawn together only where they were."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from fabricate.arrays import Floats
from fabricate.checks.fit import GAP_SHARE, WIDEST
from fabricate.checks.gap import Spacing, widest_gap
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.torus import torus
from fabricate.solid import wall_layers
from fabricate.solid.assembly import Assembly, Core, assembly
from fabricate.solid.booleans import manifold_of
from fabricate.solid.facing import middle_gaps
from fabricate.solid.joint import STRAIGHT, Joint
from fabricate.solid.settling import fitted_cut
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled
from fabricate.triangles.search_tree import SearchTree

CLEARANCE, THICKNESS = 0.3, 1.6
JOINTS = {
    "straight": STRAIGHT,
    "draft": Joint(kind="draft", angle=5.0),
    "tongue": Joint(kind="tongue", height=0.3, width=1.1),
}


@cache
def bent() -> CutSurface:
    """Return a small torus: its hole is a saddle, in whose tight bends copies are pushed far apart."""
    quads = tiled(sized(torus(around=8, across=4, tube=0.45), size=40), tile_size=6)
    return fitted_cut(grown_duotone(quads, tree="random", seed=3), tolerance=0.3, clearance=CLEARANCE)


def built(joint: str, core: Core = "hollow") -> Assembly:
    surface = bent()
    inner = surface.points - THICKNESS * surface.normals
    return assembly(surface, inner, clearance=CLEARANCE, core=core, joint=JOINTS[joint])


def widest(made: Assembly) -> float:
    first, second = (SearchTree.of(part.points, part.triangles) for part in made.parts)
    found = widest_gap(Spacing.between(first, second, clearance=CLEARANCE), made.middles(bent().curves[0], 0))
    assert found is not None
    return found[0] / CLEARANCE


def middles(made: Assembly) -> Floats:
    """Return the widest gap along the mid-line beside each curve point, (c,), in clearances."""
    left, right = made.walls(bent().curves[0], 0)
    return middle_gaps(left, right) / CLEARANCE


@pytest.mark.parametrize("joint", list(JOINTS))
def test_the_gap_in_tight_bends_is_neither_too_small_nor_far_too_wide(
    monkeypatch: pytest.MonkeyPatch, joint: str
) -> None:
    made = built(joint)
    yellow, blue = map(manifold_of, made.parts)
    assert yellow.min_gap(blue, 2 * CLEARANCE) >= GAP_SHARE * CLEARANCE
    assert widest(made) <= WIDEST
    monkeypatch.setattr(wall_layers, "DRAWINGS", 0)
    assert widest(built(joint)) > WIDEST


@pytest.mark.parametrize("core", ["yellow", "blue"])
def test_the_gap_beside_a_core_is_as_wide_as_the_clearance(core: Core) -> None:
    yellow, blue = map(manifold_of, built("draft", core).parts)
    assert yellow.min_gap(blue, 2 * CLEARANCE) >= GAP_SHARE * CLEARANCE


def test_walls_that_are_not_too_wide_apart_stay_where_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn = built("straight")
    monkeypatch.setattr(wall_layers, "DRAWINGS", 0)
    pushed = built("straight")
    wide = middles(pushed) > wall_layers.WIDE - 1e-3
    beside = wide | np.roll(wide, 1) | np.roll(wide, -1)
    moved = np.any(drawn.walls(bent().curves[0], 0) != pushed.walls(bent().curves[0], 0), axis=(0, 1, 3))
    assert 0 < moved.sum() < 0.5 * len(moved)
    assert not (moved & ~beside).any()


@pytest.mark.parametrize(("joint", "asked"), [("draft", THICKNESS * np.tan(np.radians(5.0))), ("tongue", 0.3)])
def test_a_joint_keeps_its_size_where_there_is_no_need_to_make_it_smaller(joint: str, asked: float) -> None:
    straight, walls = (built(each).walls(bent().curves[0], 0).mean(axis=0) for each in ("straight", joint))
    aside = walls[-1] - straight[-1] if joint == "draft" else walls[3] - walls[[0, -1]].mean(axis=0)
    assert np.median(np.linalg.norm(aside, axis=1)) > 0.8 * asked
