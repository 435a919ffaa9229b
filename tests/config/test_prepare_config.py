"""The section [prepare]: what is mended and made of a mesh, and what it refuses."""

from __future__ import annotations

from pathlib import Path

import pytest

from fabricate.config import load_config
from fabricate.errors import ConfigError


@pytest.mark.parametrize(
    ("setting", "word"),
    [
        ("prepare.repair=gentel", "gentle"),
        ("prepare.cells=quad", "quads"),
        ("prepare.components=all", '"each"'),
        ("prepare.detail=1", '"smooth"'),
        ("prepare.max_faces=0", "at least 1"),
        ("prepare.mend=gentle", "unknown key"),
    ],
)
def test_wrong_values_are_named(tmp_path: Path, setting: str, word: str) -> None:
    path = tmp_path / "some.toml"
    path.write_text('source.shape = "cube"\n')
    with pytest.raises(ConfigError, match=word) as caught:
        load_config(path, [setting])
    assert setting.partition("=")[0] in str(caught.value)


def test_tiles_may_be_as_fine_as_they_print(tmp_path: Path) -> None:
    path = tmp_path / "some.toml"
    path.write_text('source.shape = "cube"\npattern.tile_size = "auto"\n')
    assert load_config(path).pattern.tile_size == "auto"


@pytest.mark.parametrize("found", ['"7"', '"0 mm"', '"atuo"', "7", "true"])
def test_a_tile_size_is_a_length_or_auto(tmp_path: Path, found: str) -> None:
    path = tmp_path / "some.toml"
    path.write_text(f'source.shape = "cube"\npattern.tile_size = {found}\n')
    with pytest.raises(ConfigError, match=r"pattern\.tile_size: expected"):
        load_config(path)
