from collections.abc import Callable
from pathlib import Path

import pytest

from fabricate.config import Config, load_config


@pytest.fixture
def read(tmp_path: Path) -> Callable[..., Config]:
    """Load a text as the config `some.toml`, with overrides."""

    def _read(text: str, *overrides: str) -> Config:
        path = tmp_path / "some.toml"
        path.write_text(text, encoding="utf-8")
        return load_config(path, overrides)

    return _read
