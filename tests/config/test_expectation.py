"""What a key takes is said in words, with every bound."""

import pytest

from fabricate.config import ShopConfig
from fabricate.config.expectation import expectation
from fabricate.config.keys import SECTIONS

FIELDS = {
    f"{model.__name__}.{key}": field
    for models in SECTIONS.values()
    for model in models
    for key, field in model.model_fields.items()
} | {f"ShopConfig.{key}": field for key, field in ShopConfig.model_fields.items()}


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("CubeConfig.divisions", "a whole number, at least 1, at most 64"),
        ("CubeConfig.size", "a length, more than 0 mm, at most 10000 mm"),
        ("TorusConfig.tube", "a number, more than 0, less than 1"),
        ("KnotConfig.tube", "a number, at least 0.05, at most 0.76"),
        ("FileConfig.path", "text"),
        ("PatternConfig.tile_size", '"auto" or a length, more than 0 mm'),
        ("PatternConfig.levels", "a whole number, at least 0, at most 12"),
        ("PatternConfig.arc", "a number, more than 0.293, less than 0.707"),
        ("PrepareConfig.crease", "an angle, at least 0 deg, at most 180 deg"),
        ("PatternConfig.locks", "tables [[pattern.locks]]"),
        ("HeightConfig.axis", "three numbers such as [0, 0, 1]"),
        ("HeightConfig.reverse", "true or false"),
        ("SolidConfig.thickness", "a length, more than 0 mm, or a table of min, max, by"),
        ("ShopConfig.polygons", "a whole number, at least 1000, at most 100000000"),
        ("SolidConfig.core", 'one of "hollow", "blue", "yellow"'),
    ],
)
def test_words(name: str, words: str) -> None:
    assert expectation(FIELDS[name]) == words


@pytest.mark.parametrize("name", FIELDS)
def test_every_key_has_some(name: str) -> None:
    assert expectation(FIELDS[name])
