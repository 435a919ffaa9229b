"""Widening: narrow necks grow where there is room, roomy tilings stay, hopeless ones do not hang."""

from __future__ import annotations

import numpy as np
import pytest
from crowding import crowded_torus, roomy_torus

from fabricate.duotone.duotone import Duotone
from fabricate.surface.cut import cut
from fabricate.surface.limit import LimitSurface
from fabricate.surface.neck import tile_necks
from fabricate.surface.widening import coarse_necks, widened


@pytest.fixture(scope="module")
def roomy() -> Duotone:
    return roomy_torus()


@pytest.fixture(scope="module")
def crowded() -> Duotone:
    return crowded_torus()


def test_necks_measured_quickly_are_those_of_a_fine_cut(roomy: Duotone) -> None:
    fine = tile_necks(cut(roomy, LimitSurface.of(roomy.quads), arc=0.5, resolution=24))[0]
    assert coarse_necks(roomy, arc=0.5) == pytest.approx(fine, rel=0.03)


def test_narrow_necks_grow_until_they_are_wide_enough(crowded: Duotone) -> None:
    before = coarse_necks(crowded, arc=0.5).min()
    after = widened(crowded, arc=0.5, neck=2.0 * before)
    assert coarse_necks(after, arc=0.5).min() >= 2.0 * before
    assert (after.joined == crowded.joined).all()
    assert (after.quads.tiles == crowded.quads.tiles).all()


def test_a_roomy_tiling_stays_as_it_is(roomy: Duotone) -> None:
    assert widened(roomy, arc=0.5, neck=0.5) is roomy


def test_what_cannot_be_had_ends_with_no_more_narrow_necks_than_before(roomy: Duotone) -> None:
    neck = 10.0
    narrow = [
        np.count_nonzero(coarse_necks(each, arc=0.5) < neck) for each in (roomy, widened(roomy, arc=0.5, neck=neck))
    ]
    assert 0 < narrow[1] <= narrow[0]
