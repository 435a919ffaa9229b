"""Every section and key that a config may have, and the one that a mistyped key was meant to be."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from types import MappingProxyType, UnionType
from typing import Annotated, NamedTuple, Union, get_args, get_origin

from pydantic.fields import FieldInfo

from fabricate.config.curve_config import CurveConfig
from fabricate.config.field_config import FIELDS, FieldConfig
from fabricate.config.optimise_config import OptimiseConfig
from fabricate.config.pattern_config import PatternConfig
from fabricate.config.prepare_config import PrepareConfig
from fabricate.config.process_config import ProcessConfig
from fabricate.config.section import Section
from fabricate.config.solid_config import SolidConfig
from fabricate.config.source_config import SHAPES, SourceConfig

SECTIONS: Mapping[str, tuple[type[Section], ...]] = MappingProxyType(
    {
        "source": get_args(SourceConfig),
        "prepare": (PrepareConfig,),
        "pattern": (PatternConfig,),
        "curve": (CurveConfig,),
        "field": get_args(FieldConfig),
        "optimise": (OptimiseConfig,),
        "solid": (SolidConfig,),
        "process": (ProcessConfig,),
    }
)
"""Every section and the models it may take."""


class Switch(NamedTuple):
    """The key whose word decides what other keys a section has, and the model that belongs to each word."""

    key: str
    models: Mapping[str, type[Section]]


SWITCHES: Mapping[str, Switch] = MappingProxyType({"source": Switch("shape", SHAPES), "field": Switch("kind", FIELDS)})
"""Sections that are of several kinds."""


def keys_of(section: str) -> dict[str, str]:
    """Return the dotted form of each key of a section; nothing for a section that does not exist."""
    models = SECTIONS.get(section, ())
    return {key: f"{section}.{key}" for model in models for key in model.model_fields}


def table_keys(section: str, key: str) -> dict[str, str]:
    """Return the dotted form of each key of the table that a key may have for a value; nothing if it takes none."""
    fields = [model.model_fields[key] for model in SECTIONS.get(section, ()) if key in model.model_fields]
    return {inner: f"{section}.{key}.{inner}" for table in _tables(fields) for inner in table.model_fields}


def _tables(fields: Iterable[FieldInfo]) -> list[type[Section]]:
    """Return the tables that fields may have for a value; those in a list, which have no key of their own, are none."""
    left, found = [field.annotation for field in fields], []
    while left:
        each = left.pop()
        if isinstance(each, type) and issubclass(each, Section):
            found.append(each)
        elif get_origin(each) in {Union, UnionType, Annotated}:
            left += get_args(each)
    return found


def nearest_key(key: str, first: Mapping[str, str]) -> str:
    """Return a hint at the key most like this one: among the first ones if any is, else in any section."""
    everywhere = {tail: dotted for section in SECTIONS for tail, dotted in keys_of(section).items()}
    for known in (first, everywhere):
        close = get_close_matches(key.lower(), known, n=1)
        if close:
            return f"; did you mean {known[close[0]]}?"
    return f"; known here: {', '.join((first or everywhere).values())}"
