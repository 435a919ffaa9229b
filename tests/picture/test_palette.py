"""Colours of parts: what the names say, fixed for the rest; sRGB decoding undoes encoding."""

from __future__ import annotations

import colorsys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.picture.palette import CYCLE, encoded_light, linear_light, part_colours


@pytest.mark.parametrize(("name", "low", "high"), [("yellow", 38, 60), ("blue", 205, 230)])
def test_yellow_and_blue_have_the_hue_of_their_name_wherever_they_stand(name: str, low: int, high: int) -> None:
    (colour,) = part_colours([name])
    assert low < 360 * colorsys.rgb_to_hsv(*(value / 255 for value in colour))[0] < high
    assert part_colours(["other", name])[1] == colour


def test_other_names_take_different_colours_in_order() -> None:
    colours = part_colours(["a", "yellow", "b", "blue", "c"])
    assert len(set(colours)) == 5
    assert (colours[0], colours[2], colours[4]) == CYCLE[:3]


def test_one_name_is_one_colour_and_the_cycle_starts_again() -> None:
    names = [f"part {number}" for number in range(len(CYCLE) + 1)]
    colours = part_colours([*names, names[2]])
    assert colours[len(CYCLE)] == colours[0]
    assert colours[-1] == colours[2]


@given(st.floats(0, 1))
def test_decoding_undoes_encoding(light: float) -> None:
    assert linear_light(encoded_light(np.array([light])))[0] == pytest.approx(light, abs=1e-6)


def test_encoding_is_that_of_srgb() -> None:
    # Middle grey reflects 21.4 % of the light and is coded as one half.
    assert linear_light(0.5) == pytest.approx(0.2140, abs=1e-4)
    np.testing.assert_allclose(encoded_light(np.array([0.0, 1.0])), [0.0, 1.0], atol=1e-12)
