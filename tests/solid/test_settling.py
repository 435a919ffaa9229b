"""Settling: roomy tilings stay as they are, crowded tiles grow until the clearance fits."""

from __future__ import annotations

import numpy as np
import pytest
from crowding import crowded_torus, roomy_torus

from fabricate.duotone.duotone import Duotone
from fabricate.errors import PatternError
from fabricate.solid.settling import fitted_cut, settled, tight_tiles
from fabricate.surface.cut import cut
from fabricate.surface.limit import LimitSurface

CLEARANCE, RESOLUTION = 0.3, 4


@pytest.fixture(scope="module")
def roomy() -> Duotone:
    return roomy_torus()


@pytest.fixture(scope="module")
def crowded() -> Duotone:
    return crowded_torus()


@pytest.mark.parametrize("clearance", [0.0, CLEARANCE])
def test_a_roomy_tiling_stays_as_it_is(roomy: Duotone, clearance: float) -> None:
    plain = cut(roomy, LimitSurface.of(roomy.quads), rings=(0.5,), resolution=RESOLUTION)
    found = settled(roomy, clearance=clearance, rings=(0.5,), resolution=RESOLUTION)
    assert found.points.tobytes() == plain.points.tobytes()
    assert found.normals.tobytes() == plain.normals.tobytes()


def test_without_clearance_nothing_is_too_crowded(crowded: Duotone) -> None:
    plain = cut(crowded, LimitSurface.of(crowded.quads), rings=(0.5,), resolution=RESOLUTION)
    found = settled(crowded, clearance=0.0, rings=(0.5,), resolution=RESOLUTION)
    assert (found.points == plain.points).all()


def test_crowded_tiles_grow_until_the_clearance_fits(crowded: Duotone) -> None:
    before = cut(crowded, LimitSurface.of(crowded.quads), rings=(0.5,), resolution=RESOLUTION)
    after = settled(crowded, clearance=CLEARANCE, rings=(0.5,), resolution=RESOLUTION)
    assert tight_tiles(before, clearance=CLEARANCE).any()
    assert not tight_tiles(after, clearance=CLEARANCE).any()


def test_what_is_far_from_crowded_tiles_stays(crowded: Duotone) -> None:
    before = cut(crowded, LimitSurface.of(crowded.quads), rings=(0.5,), resolution=RESOLUTION)
    after = settled(crowded, clearance=CLEARANCE, rings=(0.5,), resolution=RESOLUTION)
    moved = (before.points != after.points).any(axis=1)
    assert 0 < moved.mean() < 0.7
    assert (before.triangles == after.triangles).all()
    assert (before.regions == after.regions).all()


def test_tight_tiles_are_where_they_were_planted(crowded: Duotone) -> None:
    surface = cut(crowded, LimitSurface.of(crowded.quads), rings=(0.5,), resolution=RESOLUTION)
    tight = tight_tiles(surface, clearance=CLEARANCE)
    centres = crowded.quads.points[crowded.quads.tiles].mean(axis=1)
    pinched = centres[tight].mean(axis=0)
    assert np.linalg.norm(centres[tight] - pinched, axis=1).max() < 15.0
    assert len(tight) == len(crowded.joined)


def test_every_tile_is_tight_for_a_huge_clearance(roomy: Duotone) -> None:
    surface = cut(roomy, LimitSurface.of(roomy.quads), rings=(0.5,), resolution=RESOLUTION)
    assert tight_tiles(surface, clearance=30.0).all()
    assert not tight_tiles(surface, clearance=0.1).any()


def test_a_finer_tolerance_gives_more_triangles_on_the_same_surface(roomy: Duotone) -> None:
    coarse, fine = (fitted_cut(roomy, tolerance=tolerance) for tolerance in (0.4, 0.1))
    assert len(fine.triangles) > len(coarse.triangles)
    corners = len(roomy.quads.points)
    assert fine.points[:corners] == pytest.approx(coarse.points[:corners], abs=1e-9)


@pytest.mark.parametrize("arc", [0.29, 0.71])
def test_arcs_that_would_meet_are_refused(roomy: Duotone, arc: float) -> None:
    with pytest.raises(PatternError, match="arc"):
        fitted_cut(roomy, rings=(arc,), tolerance=0.4)
