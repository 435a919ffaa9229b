"""Wording: numbers of things and places as messages name them."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.checks.wording import counted, place


@pytest.mark.parametrize(("number", "text"), [(0, "0 edges"), (1, "1 edge"), (2, "2 edges")])
def test_one_is_singular(number: int, text: str) -> None:
    assert counted(number, "edge") == text


def test_irregular_plurals_are_given() -> None:
    assert counted(1, "vertex", "vertices") == "1 vertex"
    assert counted(3, "vertex", "vertices") == "3 vertices"


def test_places_have_six_digits() -> None:
    assert place(np.array([1.23456789, -2.0, 1e-9])) == "(1.23457, -2, 1e-09)"
