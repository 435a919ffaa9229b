"""Welding: places stay what they are, each is named once, and only exactly equal ones become one."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fabricate.formats.welding import welded
from fabricate.mesh.polygon_mesh import PolygonMesh

COORDINATES = st.sampled_from([0.0, -0.0, 1.0, float(np.nextafter(1, 2)), 2.0])
PLACES = st.lists(st.tuples(COORDINATES, COORDINATES, COORDINATES), min_size=3, max_size=12)


@given(PLACES, st.data())
def test_corners_stay_where_they_are_and_places_are_named_once(
    places: list[tuple[float, float, float]], data: st.DataObject
) -> None:
    faces = data.draw(st.lists(st.lists(st.integers(0, len(places) - 1), min_size=3, max_size=5), min_size=1))
    mesh = PolygonMesh.from_faces(places, faces)
    joined = welded(mesh)
    np.testing.assert_array_equal(joined.points[joined.corners], mesh.points[mesh.corners])
    np.testing.assert_array_equal(joined.offsets, mesh.offsets)
    assert list(map(tuple, joined.points.tolist())) == list(dict.fromkeys(places))  # -0.0 == 0.0 in Python, too


def test_points_that_are_no_numbers_stay_apart() -> None:
    mesh = PolygonMesh.from_faces([[np.nan, 0, 0], [np.nan, 0, 0], [1, 0, 0], [1, 0, 0]], [[0, 1, 2], [1, 0, 3]])
    joined = welded(mesh)
    assert len(joined.points) == 3
    assert joined.corners.tolist() == [0, 1, 2, 1, 0, 2]
