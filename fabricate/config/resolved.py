"""The resolved config: what is kept beside the results, and the digest that names what was asked."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path

import tomli_w

from fabricate.config.config import Config
from fabricate.config.field_config import ImageConfig
from fabricate.config.source_config import FileConfig


def resolved_toml(config: Config) -> str:
    """Return the config as TOML with every default filled in; reading it gives an equal config."""
    return tomli_w.dumps(config.model_dump(mode="json", exclude_none=True))


def moved_config(config: Config, folder: Path) -> Config:
    """Return the config as it reads in another folder: a mesh file and a picture are found from there."""
    moved: dict[str, object] = {}
    if isinstance(config.source, FileConfig):
        path = _from(folder, config.source.file)
        moved["source"] = config.source.model_copy(update={"path": path})
    if isinstance(config.field, ImageConfig):
        moved["field"] = config.field.model_copy(update={"image": _from(folder, config.field.file)})
    return config.model_copy(update=moved) if moved else config


def _from(folder: Path, file: Path) -> str:
    return os.path.relpath(file.resolve(), folder.resolve())


def config_sha256(config: Config) -> str:
    """Return the SHA-256 of the resolved TOML in hexadecimal: the same for configs that mean the same."""
    return hashlib.sha256(resolved_toml(config).encode()).hexdigest()
