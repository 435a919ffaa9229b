"""Curves and regions counted from triangles: what tiles say, bands that are rings, and planted faults."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import HANDLES
from truchet import quasi_trees

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.certificate import RegionFacts, certified
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.surface.cut import CutSurface, cut
from fabricate.surface.cut_certificate import cut_certificate
from fabricate.surface.limit import LimitSurface

BAND = RegionFacts(components=1, euler_characteristic=0, handles=0)


def cut_up(duotone: Duotone, rings: tuple[float, ...]) -> CutSurface:
    return cut(duotone, LimitSurface.of(duotone.quads), rings=rings, resolution=2)


@settings(max_examples=20)
@given(duotone=quasi_trees(), rings=st.sampled_from([(0.5,), (0.4, 0.6), (0.35, 0.4, 0.5, 0.65)]))
def test_the_outer_regions_are_those_of_the_tiles_and_bands_are_rings(
    duotone: Duotone, rings: tuple[float, ...]
) -> None:
    found, tiles = cut_certificate(cut_up(duotone, rings)), certified(duotone)
    assert (found.curves, found.genus) == (len(rings), duotone.quads.genus)
    assert (found.yellow, found.blue) == (tiles.yellow, tiles.blue)
    assert found.regions[1:-1] == (len(rings) - 1) * (BAND,)
    assert found.holds


@pytest.mark.parametrize("name", HANDLES)
def test_handles_are_those_of_the_shape(name: str) -> None:
    mesh, handles = HANDLES[name]
    found = cut_certificate(cut_up(random_duotone(subdivided(mesh, levels=1), seed=4), (0.4, 0.6)))
    assert found.holds
    assert [region.handles for region in found.regions] == [0, 0, handles]


def test_a_band_that_is_cut_through_is_no_ring() -> None:
    surface = cut_up(random_duotone(subdivided(HANDLES["torus"][0], levels=1), seed=4), (0.4, 0.6))
    regions = surface.regions.copy()
    across = np.isin(surface.triangles, surface.rays[0, 0]).any(axis=1)
    regions[across & (regions == 1)] = 2
    found = cut_certificate(replace(surface, regions=regions))
    assert not found.holds
    assert found.curves == 1  # they meet at the cut
    assert found.regions[1].euler_characteristic == 1


def test_a_lost_triangle_is_a_curve_of_its_own() -> None:
    surface = cut_up(random_duotone(subdivided(HANDLES["torus"][0], levels=1), seed=4), (0.5,))
    on_curve = np.isin(surface.triangles, surface.curves).any(axis=1)
    regions = surface.regions.copy()
    regions[np.flatnonzero(~on_curve & (regions == 0))[0]] = 1
    found = cut_certificate(replace(surface, regions=regions))
    assert (found.curves, found.blue.components, found.holds) == (2, 2, False)
