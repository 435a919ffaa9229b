"""Angles in configs: text with a unit in files, degrees from Python."""

from __future__ import annotations

from pathlib import Path

import pytest

from fabricate.config import PrepareConfig, load_config
from fabricate.errors import ConfigError


def test_a_file_says_degrees(tmp_path: Path) -> None:
    path = tmp_path / "some.toml"
    path.write_text('source.shape = "cube"\nprepare.crease = "40 deg"\n')
    assert load_config(path).prepare.crease == 40.0


def test_from_python_it_is_a_number() -> None:
    assert PrepareConfig(crease=40.0).crease == 40.0
    assert PrepareConfig(crease=40.0).model_dump(mode="json")["crease"] == "40 deg"


@pytest.mark.parametrize("found", ['"40"', "40", '"40 mm"', '"x"', '"181 deg"', '"-1 deg"', '"inf deg"'])
def test_anything_else_is_one_line(tmp_path: Path, found: str) -> None:
    path = tmp_path / "some.toml"
    path.write_text(f'source.shape = "cube"\nprepare.crease = {found}\n')
    with pytest.raises(ConfigError, match=r"prepare\.crease: expected an angle") as caught:
        load_config(path)
    assert "\n" not in str(caught.value)
