"""A commented config works as it is, and so does every setting behind its "#"."""

import re
import string
import tomllib
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.config import Config, TorusConfig
from fabricate.config.commented import commented_toml
from fabricate.config.field_config import FIELDS
from fabricate.config.keys import SECTIONS
from fabricate.config.section import ConfigFolder
from fabricate.config.source_config import SHAPES


def reread(text: str) -> Config:
    return Config.model_validate(tomllib.loads(text), context=ConfigFolder(Path()))


def switched_on(text: str, keys: set[str]) -> str:
    """Remove the "#" before some keys."""
    return re.sub(rf"^#(?=({'|'.join(keys)}) = )", "", text, flags=re.MULTILINE)


def test_a_commented_config_works_as_it_is() -> None:
    text = commented_toml("first")
    assert text.startswith("# first: ")
    assert reread(text) == Config(source=TorusConfig())


def test_a_commented_config_shows_every_key() -> None:
    shown = set(re.findall(r"^#?(\w+) = ", commented_toml("first"), flags=re.MULTILINE))
    assert shown == {key for models in SECTIONS.values() for model in models for key in model.model_fields}


def test_a_commented_config_says_what_each_key_means() -> None:
    lines = commented_toml("first").splitlines()
    for before, line in pairwise(lines):
        if re.match(r"#?\w+ = ", line):
            assert before.startswith("# ")


def test_the_settings_behind_the_sign_are_defaults_that_work() -> None:
    text = switched_on(commented_toml("first"), {"thickness", "clearance"})
    assert reread(text) == Config(source=TorusConfig())


@pytest.mark.parametrize(
    ("key", "other"), [("levels", "tile_size"), ("path", "shape|around|across|tube")], ids=["levels", "path"]
)
def test_the_alternatives_behind_the_sign_work(key: str, other: str) -> None:
    without = re.sub(rf"^(?=({other}) = )", "#", commented_toml("first"), flags=re.MULTILINE)
    assert reread(switched_on(without, {key})) != Config(source=TorusConfig())


@pytest.mark.parametrize("shape", [shape for shape in SHAPES if shape != "torus"])
def test_the_keys_of_each_shape_behind_the_sign_are_its_defaults(shape: str) -> None:
    block = re.search(rf'^# Keys of shape = .*"{shape}".*:\n((#.* = .*\n|# .*\n)*?)(?=# Keys of|# Mesh file)',
                      commented_toml("first"), flags=re.MULTILINE)  # fmt: skip
    assert block is not None
    settings: dict[str, Any] = tomllib.loads(re.sub(r"^#(?=\w)", "", block[1], flags=re.MULTILINE))
    assert settings
    assert Config.model_validate({"source": {"shape": shape, **settings}}) == Config.model_validate(
        {"source": {"shape": shape}}
    )


@pytest.mark.parametrize("kind", FIELDS)
def test_the_keys_of_each_field_behind_the_sign_are_its_defaults(kind: str) -> None:
    block = re.search(rf'^# Keys of kind = "{kind}".*:\n((#.* = .*\n|# .*\n)*?)(?=# Keys of|\n)',
                      commented_toml("first"), flags=re.MULTILINE)  # fmt: skip
    assert block is not None
    settings: dict[str, Any] = tomllib.loads(re.sub(r"^#(?=\w)", "", block[1], flags=re.MULTILINE))
    model = FIELDS[kind]
    assert {"kind", *settings} == set(model.model_fields)
    found = model.model_validate({"kind": kind, **settings}, context=ConfigFolder(Path()))
    defaults = {key: value for key, value in model.model_construct().model_dump().items() if value is not None}
    assert found.model_dump().items() >= defaults.items()


@given(st.text(string.ascii_letters + string.digits + "_", min_size=1, max_size=20))
def test_any_name_gives_a_config_that_works(name: str) -> None:
    assert reread(commented_toml(name)) == Config(source=TorusConfig())
