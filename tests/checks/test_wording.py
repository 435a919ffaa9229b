"""Wording: numbers of things and places as messages name them."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.checks.wording import counted, place, share_of, told_apart


@pytest.mark.parametrize(("number", "text"), [(0, "0 edges"), (1, "1 edge"), (2, "2 edges")])
def test_one_is_singular(number: int, text: str) -> None:
    assert counted(number, "edge") == text


def test_irregular_plurals_are_given() -> None:
    assert counted(1, "vertex", "vertices") == "1 vertex"
    assert counted(3, "vertex", "vertices") == "3 vertices"


def test_places_have_six_digits() -> None:
    assert place(np.array([1.23456789, -2.0, 1e-9])) == "(1.23457, -2, 1e-09)"


@pytest.mark.parametrize(
    ("found", "limit", "text"),
    [(0.12345, 0.8, "0.1235"), (0.79999, 0.8, "0.79999"), (0.7999996, 0.8, "0.7999996"), (0.8, 0.8, "0.8")],
)
def test_a_number_beside_a_limit_is_told_from_it(found: float, limit: float, text: str) -> None:
    assert told_apart(found, limit) == text


@pytest.mark.parametrize(
    ("share", "text"), [(0.0, "less than 0.01%"), (0.00009, "less than 0.01%"), (0.0125, "1.25%"), (1.0, "100.00%")]
)
def test_a_small_share_is_not_called_none(share: float, text: str) -> None:
    assert share_of(share) == text
