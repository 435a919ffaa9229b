from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.arrays import frozen


@given(
    values=st.lists(st.tuples(st.integers(-9, 9), st.integers(-9, 9)), max_size=5),
    dtype=st.sampled_from([np.float64, np.int64]),
)
def test_values_type_and_shape(values: list[tuple[int, int]], dtype: type[np.generic]) -> None:
    array = frozen(np.array(values).reshape(-1, 2), dtype, (None, 2))
    assert array.dtype == dtype
    assert array.shape == (len(values), 2)
    assert array.tolist() == [list(row) for row in values]
    assert array.flags.c_contiguous


@pytest.mark.parametrize("source", [[1.0, 2.0], (1, 2), np.array([1.0, 2.0]), np.array([1, 9, 2, 9])[::2]])
def test_nobody_can_write(source: object) -> None:
    array = frozen(source, np.float64, (2,))  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="read-only"):
        array[0] = 5


def test_the_source_stays_writable_and_apart() -> None:
    source = np.array([1.0, 2.0])
    array = frozen(source, np.float64, (None,))
    source[0] = 7
    assert array.tolist() == [1.0, 2.0]


def test_what_is_frozen_already_is_not_copied() -> None:
    array = frozen([1.0, 2.0], np.float64, (None,))
    assert frozen(array, np.float64, (2,)) is array


def test_transposed_arrays_become_contiguous() -> None:
    array = frozen(np.arange(6.0).reshape(2, 3).T, np.float64, (3, 2))
    assert array.flags.c_contiguous
    assert array.tolist() == [[0, 3], [1, 4], [2, 5]]


@pytest.mark.parametrize(
    ("found", "wanted", "message"),
    [
        ((4, 2), (None, 3), r"shape \(n, 3\), found \(4, 2\)"),
        ((4,), (None, 3), r"shape \(n, 3\), found \(4,\)"),
        ((4, 3, 1), (None, 3), r"shape \(n, 3\), found \(4, 3, 1\)"),
        ((5,), (4,), r"shape \(4\), found \(5,\)"),
        ((0,), (4,), r"shape \(4\), found \(0,\)"),
    ],
)
def test_another_shape_is_an_error(found: tuple[int, ...], wanted: tuple[int | None, ...], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        frozen(np.zeros(found), np.float64, wanted)
