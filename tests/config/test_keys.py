"""Every key is known once, says what it means, and is the hint that its misspellings get."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.config import Config
from fabricate.config.keys import SECTIONS, keys_of, nearest_key

ALL_KEYS = sorted({dotted for section in SECTIONS for dotted in keys_of(section).values()})


def test_sections_are_those_of_the_config() -> None:
    assert list(SECTIONS) == list(Config.model_fields)


def test_keys_of_a_section_are_those_of_all_its_models() -> None:
    assert keys_of("solid")["thickness"] == "solid.thickness"
    assert {"path", "shape", "divisions", "hole"} <= set(keys_of("source"))
    assert keys_of("sorce") == {}


def test_every_key_says_what_it_means() -> None:
    for models in SECTIONS.values():
        for model in models:
            assert model.__doc__
            for field in model.model_fields.values():
                assert field.description
                assert field.description.endswith(".")


@given(dotted=st.sampled_from(ALL_KEYS), data=st.data())
def test_a_key_with_one_letter_too_many_is_recognised(dotted: str, data: st.DataObject) -> None:
    section, _, key = dotted.partition(".")
    place = data.draw(st.integers(0, len(key)))
    mistyped = key[:place] + "x" + key[place:]
    assert nearest_key(mistyped, keys_of(section)) == f"; did you mean {dotted}?"


@pytest.mark.parametrize(
    ("key", "section", "hint"),
    [
        ("THICKNESS", "solid", "; did you mean solid.thickness?"),
        ("thickness", "source", "; did you mean solid.thickness?"),
        ("thickness", "sold", "; did you mean solid.thickness?"),
        ("xyz", "process", "; known here: process.name, process.shop"),
    ],
)
def test_keys_are_looked_for_here_and_then_everywhere(key: str, section: str, hint: str) -> None:
    assert nearest_key(key, keys_of(section)) == hint
