from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fabricate.prepare.places import place_numbers

coordinates = st.sampled_from([0.0, -0.0, 1.0, 1e-300, 5.0])


@given(st.lists(st.tuples(coordinates, coordinates, coordinates), max_size=20))
def test_places_are_numbered_as_by_a_dictionary(points: list[tuple[float, float, float]]) -> None:
    numbers: dict[tuple[float, float, float], int] = {}
    expected = [numbers.setdefault(point, len(numbers)) for point in points]  # -0.0 == 0.0, also as keys
    assert place_numbers(np.array(points).reshape(-1, 3)).tolist() == expected


def test_what_is_no_number_is_nowhere_else() -> None:
    assert place_numbers(np.full((2, 3), np.nan)).tolist() == [0, 1]
