"""Places for a coupon: the narrowest necks and the bends of median curvature, by definition."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from coupons import subject

from fabricate.solid.coupon_places import bend_places, neck_places
from fabricate.surface.neck import tile_necks
from fabricate.triangles.search_tree import SearchTree

RING = "ring"


def nearest_region(at: np.ndarray) -> int:
    """Return the region of the triangle of the ring that is nearest to a place."""
    surface = subject(RING).surface
    return int(surface.regions[SearchTree.of(surface.points, surface.triangles).nearest(at[None]).triangle[0]])


def three_point_radius(begin: np.ndarray, middle: np.ndarray, end: np.ndarray) -> float:
    """Return the radius of the circle through three points, from its centre."""
    rows = np.array([middle - begin, end - begin, np.cross(middle - begin, end - begin)])
    sides = np.array([(middle @ middle - begin @ begin) / 2, (end @ end - begin @ begin) / 2, rows[2] @ begin])
    return float(np.linalg.norm(np.linalg.solve(rows, sides) - begin))


def test_necks_begin_with_the_narrowest() -> None:
    widths, middles = tile_necks(subject(RING).surface)
    places = neck_places(subject(RING).surface, subject(RING).joined)
    assert places[0].size == widths.min()
    assert places[0].at.tolist() == middles[widths.argmin()].tolist()
    assert all(one.size <= other.size for one, other in pairwise(places))


def test_a_neck_lies_in_the_region_that_it_joins() -> None:
    places = neck_places(subject(RING).surface, subject(RING).joined)
    assert {place.region for place in places} == {0, 1}
    assert all(nearest_region(place.at) == place.region for place in places)


def test_bends_begin_with_the_one_nearest_to_the_median_curvature() -> None:
    surface = subject(RING).surface
    arcs = surface.points[surface.arcs[0]]
    curvatures = np.array([1.0 / three_point_radius(arc[0], arc[len(arc) // 2], arc[-1]) for arc in arcs])
    nearest = curvatures[np.abs(curvatures - np.median(curvatures)).argmin()]
    assert bend_places(surface, subject(RING).joined)[0].size == pytest.approx(1.0 / nearest)


def test_the_region_of_a_bend_is_on_its_inner_side() -> None:
    surface = subject(RING).surface
    numbers = surface.arcs[0]
    middles = numbers[:, numbers.shape[1] // 2]
    for place in bend_places(surface, subject(RING).joined):
        arc = int(np.linalg.norm(surface.points[middles] - place.at, axis=1).argmin())
        normal, ends = surface.normals[middles[arc]], surface.points[numbers[arc, [0, -1]]]
        inwards = ends.mean(axis=0) - place.at
        inwards -= (inwards @ normal) * normal
        assert nearest_region(place.at + inwards / np.linalg.norm(inwards)) == place.region


def test_along_is_the_way_that_the_curve_runs() -> None:
    surface = subject(RING).surface
    curve = surface.points[surface.curves[0]]
    for place in bend_places(surface, subject(RING).joined)[:20]:
        nearest = int(np.linalg.norm(curve - place.at, axis=1).argmin())
        way = curve[(nearest + 1) % len(curve)] - curve[nearest - 1]
        cosine = way @ place.along / np.linalg.norm(way) / np.linalg.norm(place.along)
        assert cosine == pytest.approx(1.0, abs=1e-6)


def test_of_several_rings_necks_are_in_yellow_and_blue_alone() -> None:
    bands = subject("bands")
    assert {place.region for place in neck_places(bands.surface, bands.joined)} <= {0, 3}
    assert {place.region for place in bend_places(bands.surface, bands.joined)} <= {0, 3}


def test_places_are_read_only() -> None:
    (first, *_) = neck_places(subject(RING).surface, subject(RING).joined)
    with pytest.raises(ValueError, match="read-only"):
        first.at[0] = 1.0
