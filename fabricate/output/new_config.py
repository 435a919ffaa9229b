"""A new config file, which never takes the place of another one."""

from __future__ import annotations

import re
from pathlib import Path

from fabricate.config.commented import commented_toml
from fabricate.errors import ConfigError
from fabricate.output.files import beside, output_error

_NAME = re.compile(r"\w[\w.-]*")


def write_new_config(name: str, folder: Path) -> Path:
    """Write a commented config to NAME.toml in a folder and return its path.

    The file appears whole or not at all.

    Raises
    ------
    ConfigError
        If the name cannot be the stem of a file everywhere, or such a file exists already.
    OutputError
        If the file cannot be written.
    """
    if not _NAME.fullmatch(name) or name.endswith(".toml"):
        raise ConfigError(f'expected a name of letters, digits, "-", "_" and ".", without .toml, found {name!r}')
    path = folder / f"{name}.toml"
    try:
        _write_new(path, commented_toml(name).encode())
    except FileExistsError:
        raise ConfigError(f"{path}: exists already; choose another name or remove it") from None
    except OSError as reason:
        raise output_error(path, reason) from reason
    return path


def _write_new(path: Path, content: bytes) -> None:
    """Write a file beside `path` and let it have that name, which fails where the name is taken."""
    temporary = beside(path, "part")
    try:
        temporary.write_bytes(content)
        try:
            path.hardlink_to(temporary)
        except FileExistsError:
            raise
        except OSError:  # a disk such as FAT has no links: hold the name with an empty file for a moment
            path.touch(exist_ok=False)
            temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
