"""A commented config to start from: every key with its meaning, bounds and default."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import tomli_w
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from fabricate.config.config import Config
from fabricate.config.expectation import expectation
from fabricate.config.keys import SECTIONS, SWITCHES
from fabricate.config.process_config import PROCESS_DEFAULTS
from fabricate.config.source_config import SHAPES, FileConfig, TorusConfig
from fabricate.process import PROCESSES
from fabricate.units import format_length

_HEADER = """\
# {name}: say here in one line what this config shows.
# Make it with `fabricate run {name}.toml`. Lengths are text with a unit: mm, cm or in.
# A key behind "#" is a default or an alternative: remove the "#" to use it.
"""


def commented_toml(name: str) -> str:
    """Return a config that works as it is and shows every key with its meaning, bounds and default."""
    others = [
        _kinds(section) if section in SWITCHES else _section(section, models[0])
        for section, models in SECTIONS.items()
        if section != "source"
    ]
    return "\n".join([_HEADER.format(name=name), _source(), *others])


def _source() -> str:
    """Return [source] with one shape in use; the keys of the others and of a file stand behind "#"."""
    shapes = ", ".join(f'"{shape}"' for shape in SHAPES)
    lines = [
        f"[source]  # {Config.model_fields['source'].description}",
        f"# Built-in shape: {shapes}.",
        'shape = "torus"',
        *_entries(TorusConfig, skip={"shape"}),
    ]
    for model in dict.fromkeys(SHAPES.values()):
        if model is not TorusConfig:
            owners = " or ".join(f'"{shape}"' for shape, owner in SHAPES.items() if owner is model)
            lines += [f"# Keys of shape = {owners}:", *_entries(model, skip={"shape", "size"}, used=False)]
    lines += _entries(FileConfig, skip={"size"}, used=False)
    return "\n".join(lines) + "\n"


def _kinds(section: str) -> str:
    """Return a section that is of one of several kinds, or left out: all of it stands behind "#"."""
    key, models = SWITCHES[section]
    first = next(iter(models))
    lines = [
        f"#[{section}]  # {Config.model_fields[section].description}",
        f"# Of one kind: {', '.join(models)}.",
        f'#{key} = "{first}"',
    ]
    for word, model in models.items():
        lines += [f'# Keys of {key} = "{word}", {_lower(model.__doc__)}', *_entries(model, skip={key}, used=False)]
    return "\n".join(lines) + "\n"


def _lower(sentence: str | None) -> str:
    """Return a sentence as part of another one, with a colon at its end."""
    text = sentence or ""
    return f"{text[:1].lower()}{text[1:].rstrip('.')}:"


def _section(name: str, model: type[BaseModel]) -> str:
    return "\n".join([f"[{name}]  # {model.__doc__}", *_entries(model)]) + "\n"


def _entries(model: type[BaseModel], *, skip: Collection[str] = (), used: bool = True) -> list[str]:
    defaults = model.model_construct().model_dump(mode="json")
    return [
        line
        for key, field in model.model_fields.items()
        if key not in skip
        for line in _entry(key, field, defaults.get(key), used=used)
    ]


def _entry(key: str, field: FieldInfo, default: object, *, used: bool) -> tuple[str, str]:
    """Return a line that says what a key means, and one that sets it and says what else it takes."""
    shown = next(iter(field.examples or ())) if default is None else default
    value = _inline(shown)
    note = "" if default is None else f"; default {value}"
    if key in PROCESS_DEFAULTS:
        used = False
        note = "; default: " + ", ".join(f"{name} {_default(name, key)}" for name in PROCESSES)
    switch = "" if used and default is not None else "#"
    return f"# {field.description}", f"{switch}{key} = {value}  # {expectation(field)}{note}"


def _inline(value: object) -> str:
    """Return a value as TOML has it on one line."""
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{key} = {_inline(each)}" for key, each in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_inline, value)) + "]"
    return tomli_w.dumps({"value": value}).rstrip().partition(" = ")[2]


def _default(process: str, key: str) -> str:
    return format_length(getattr(PROCESSES[process], PROCESS_DEFAULTS[key]))
