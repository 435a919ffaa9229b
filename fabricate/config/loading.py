"""Reading a config file, and saying in one line what is wrong with it."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from fabricate.config.complaint import first_complaint
from fabricate.config.config import Config
from fabricate.config.overrides import parse_setting, with_setting
from fabricate.config.section import ConfigFolder
from fabricate.errors import ConfigError


def load_config(path: Path, overrides: Sequence[str] = ()) -> Config:
    """Read a TOML config and apply overrides such as "solid.thickness=2mm".

    An override takes the place of its alternative as well: "pattern.levels=2" of a `tile_size` in the file.

    Raises
    ------
    ConfigError
        If the file cannot be read, is not TOML, or anything in it or in an override is wrong; names the
        key, what was expected and what was found.
    """
    document = _read_document(path)
    settings = [parse_setting(override) for override in overrides]
    for setting in settings:
        document = with_setting(document, setting)
    try:
        return Config.model_validate(document, context=ConfigFolder(path.parent))
    except ValidationError as error:
        complaint = first_complaint(error, document)
        origin = "--set" if any(setting.holds(complaint.key) for setting in settings) else path
        raise ConfigError(f"{origin}: {complaint.key}: {complaint.sentence}") from None


def _read_document(path: Path) -> dict[str, Any]:
    text = _read_text(path)
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ConfigError(f"{path}: not a config: its values are nested too deeply") from None
    except ValueError as error:
        last_line = f"at line {len(text.splitlines())}, the last one"
        reason = str(error).replace("at end of document", last_line)
        raise ConfigError(f"{path}: not valid TOML: {reason}") from None


def _read_text(path: Path) -> str:
    try:
        return path.read_bytes().decode("utf-8-sig")
    except FileNotFoundError:
        raise ConfigError(f"{path}: no such file; `fabricate new NAME` writes a first config") from None
    except IsADirectoryError:
        raise ConfigError(f"{path}: expected a TOML config file, found a folder") from None
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise ConfigError(f"{path}: expected UTF-8 text, found another byte at {error.start}") from None
