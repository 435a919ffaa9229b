"""Ways in: points without one are found, and get one when a few points move; nothing crosses, the rest stays."""

from __future__ import annotations

import numpy as np
from small_ring import ring_surface

from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.ear_clipping import ear_clipped
from fabricate.solid.ways_in import opened, opened_points, without_ways_in
from fabricate.triangles.crossing import crossing_triangles

ZIGZAG = [(-3, -2), (3, -2), (3, -1), (-0.2, -0.5), (3, 0), (3, 2), (-3, 2), (-3, 1), (0.2, 0.5), (-3, 0)]
"""A polygon, counterclockwise, no place of which sees all its sides."""

ROUND = [(np.cos(angle), np.sin(angle)) for angle in np.arange(12) * np.pi / 6.0]


BLADES = [
    (radius * np.cos(angle), radius * np.sin(angle))
    for turn in range(3)
    for radius, angle in ((3.0, 2.0 * np.pi / 3.0 * turn), (1.0, 2.0 * np.pi / 3.0 * (turn + 0.9)))
]
"""Three blades round a middle, so sharp that there is no way in from their tips."""


def pyramid(base: list[tuple[float, float]]) -> tuple[np.ndarray, np.ndarray]:
    """Return the points, the apex first, and triangles, outward, of a pyramid on a polygon: its apex sees all of it."""
    around = 1 + np.arange(len(base))
    points = np.concatenate([[[0.0, 0.0, 2.0]], np.column_stack([base, np.zeros(len(base))])])
    floor = ear_clipped(PolygonMesh(points, around[::-1], np.array([0, len(base)]))).triangles
    sides = np.stack([np.zeros_like(around), around, np.roll(around, -1)], axis=1)
    return points, np.concatenate([sides, floor])


def test_the_apex_over_a_polygon_that_no_place_sees_all_of_has_no_way_in() -> None:
    points, triangles = pyramid(ZIGZAG)
    assert len(crossing_triangles(points, triangles)) == 0
    assert np.flatnonzero(without_ways_in(points, triangles)).tolist() == [0]


def test_points_over_a_round_one_have() -> None:
    assert not without_ways_in(*pyramid(ROUND)).any()


def test_points_move_until_there_is_a_way_in_and_nothing_crosses() -> None:
    points, triangles = pyramid(BLADES)
    assert np.flatnonzero(without_ways_in(points, triangles)).tolist() == [1, 3, 5]
    made = opened_points(points, triangles)
    assert not without_ways_in(made, triangles).any()
    assert len(crossing_triangles(made, triangles)) == 0


def test_a_surface_with_ways_in_everywhere_is_returned_as_it_is() -> None:
    surface = ring_surface()
    assert opened(surface) is surface
