"""Roomy places are in the middle of regions: no point beside them is farther from the curves."""

from __future__ import annotations

import numpy as np
from crafted import crafted

from fabricate.mesh.torus import torus
from fabricate.solid.room import roomy_places


def test_places_are_the_widest_of_their_neighbourhood_and_on_the_region_they_say() -> None:
    surface = crafted(torus(around=8, across=4, tube=0.45), size=60, tile=12, clearance=0.0).surface
    places = roomy_places(surface)
    curve = surface.points[surface.curves.ravel()]
    room = np.linalg.norm(surface.points[:, None] - curve, axis=2).min(axis=1)
    regions = np.full(len(room), -1)
    regions[surface.triangles] = surface.regions[:, None]
    assert set(places.part.tolist()) == {0, 1}
    number = {tuple(point): k for k, point in enumerate(surface.points.tolist())}
    for place, width, part in zip(places.points.tolist(), places.room, places.part, strict=True):
        k = number[tuple(place)]
        beside = np.unique(surface.triangles[(surface.triangles == k).any(axis=1)])
        assert abs(width - room[k]) < 1e-9
        assert width >= room[beside].max() - 1e-9
        assert part == regions[k]


def test_some_are_chosen_in_order() -> None:
    surface = crafted(torus(around=8, across=4, tube=0.45), size=60, tile=12, clearance=0.0).surface
    places = roomy_places(surface)
    two = places.chosen(np.array([3, 1]))
    assert np.array_equal(two.points, places.points[[3, 1]])
    assert np.array_equal(two.room, places.room[[3, 1]])
