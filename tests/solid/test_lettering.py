"""Raised numbers: one solid for each letter, as large as asked for, and no two alike."""

from __future__ import annotations

from itertools import combinations

import pytest

from fabricate.solid.lettering import raised_text, text_width

SIZE = {"height": 6.0, "stroke": 1.0}
DIGITS = "0123456789"


@pytest.mark.parametrize("letter", [*DIGITS, "."])
def test_every_letter_is_one_solid_with_as_many_holes_as_it_should(letter: str) -> None:
    solid = raised_text(letter, **SIZE, thickness=0.6)
    assert len(solid.decompose()) == 1
    assert solid.genus() == {"0": 1, "4": 0, "6": 1, "8": 2, "9": 1}.get(letter, 0)


@pytest.mark.parametrize(("one", "other"), [*combinations(DIGITS, 2)])
def test_no_two_digits_are_alike(one: str, other: str) -> None:
    first, second = (raised_text(letter, **SIZE, thickness=1.0) for letter in (one, other))
    differing = (first - second).volume() + (second - first).volume()
    assert differing > SIZE["stroke"] ** 2


def test_letters_stand_side_by_side_from_the_origin_on_the_ground() -> None:
    text = raised_text("0.25", **SIZE, thickness=0.6)
    assert len(text.decompose()) == 4
    assert text.bounding_box() == pytest.approx((0.0, 0.0, 0.0, text_width("0.25", **SIZE), 6.0, 0.6))


def test_a_one_is_as_wide_as_any_digit() -> None:
    assert text_width("1.11", **SIZE) == text_width("8.88", **SIZE)


def test_strokes_are_as_wide_as_asked_for() -> None:
    # an eight has three level strokes, and two upright ones in what height they leave
    width, height, stroke = text_width("8", **SIZE), SIZE["height"], SIZE["stroke"]
    area = 3.0 * stroke * width + 2.0 * stroke * (height - 3.0 * stroke)
    assert raised_text("8", **SIZE, thickness=1.0).volume() == pytest.approx(area)


def test_other_letters_are_unknown() -> None:
    with pytest.raises(KeyError):
        raised_text("0,3", **SIZE, thickness=0.6)
