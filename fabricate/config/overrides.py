"""Settings from the command line, such as "solid.thickness=2mm", laid over what a config file says."""

from __future__ import annotations

import tomllib
from typing import Any, NamedTuple

from fabricate.config.keys import keys_of, nearest_key, table_keys
from fabricate.errors import ConfigError

_REPLACES = {
    "pattern.arc": ("rings", "area_share"),
    "pattern.area_share": ("arc", "rings"),
    "pattern.levels": ("tile_size",),
    "pattern.rings": ("arc", "area_share"),
    "pattern.tile_size": ("levels",),
    "source.shape": ("path",),
    "source.path": ("shape",),
}


class Setting(NamedTuple):
    """A dotted key that exists, and the value it is to have."""

    key: str
    value: object

    def holds(self, key: str) -> bool:
        """Return whether a dotted key is this one, or within the table or list that it has for a value."""
        return key == self.key or key.startswith((f"{self.key}.", f"{self.key}["))


def parse_setting(override: str) -> Setting:
    """Split "section.key=value"; the value is TOML where it can be read as such and plain text otherwise.

    Of a key that takes a table, "section.key.inner=value" sets one key of it.

    Raises
    ------
    ConfigError
        If there is no "=", or no such key; names the nearest one.
    """
    key, equals, text = (part.strip() for part in override.partition("="))
    if not equals or not key:
        raise ConfigError(f'--set: expected key=value such as solid.thickness=2mm, found "{override}"')
    section, _, name = key.partition(".")
    known = keys_of(section)
    outer, _, inner = name.partition(".")
    tabled = table_keys(section, outer) if inner else {}
    if tabled and inner not in tabled:
        raise ConfigError(f"--set: {key}: unknown key{nearest_key(inner, tabled)}")
    if not tabled and name not in known:
        raise ConfigError(f"--set: {key}: unknown key{nearest_key(name or ('' if known else key), known)}")
    try:
        parsed = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        return Setting(key, text)
    return Setting(key, parsed["value"] if len(parsed) == 1 else text)


def with_setting(document: dict[str, Any], setting: Setting) -> dict[str, Any]:
    """Return the raw config with one key set, and without the key that it is an alternative to.

    A key within a table is set beside those that are there already; a table that is missing has that key alone.
    """
    section, _, dotted = setting.key.partition(".")
    name, _, inner = dotted.partition(".")
    table = document.get(section, {})
    if not isinstance(table, dict):
        return document  # validation says that a section was expected
    kept = {other: found for other, found in table.items() if other not in _REPLACES.get(setting.key, ())}
    value: object = setting.value
    if inner:
        present = kept.get(name)
        value = {**(present if isinstance(present, dict) else {}), inner: value}
    return {**document, section: {**kept, name: value}}
