"""What is wrong with a config, in one sentence: the key, what was expected and what was found."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches
from typing import Any, Literal, NamedTuple, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from fabricate.config.expectation import expectation
from fabricate.config.keys import SECTIONS, SWITCHES, keys_of, nearest_key
from fabricate.config.section import Section

_RANK = {"extra_forbidden": 0, "literal_error": 2}
"""Unknown keys come first; of a key that takes a length or a word, what is wrong with the length comes before."""


class Complaint(NamedTuple):
    """A dotted key or the name of a section, and the sentence about it."""

    key: str
    sentence: str


class _Place(NamedTuple):
    """Where a mistake is within a section: the dotted key, its last part, and the model whose key that is."""

    dotted: str
    key: str
    model: type[BaseModel]


def first_complaint(error: ValidationError, document: Mapping[str, Any]) -> Complaint:
    """Return the first mistake in a document; unknown keys come before missing ones."""
    details = min(error.errors(include_url=False), key=lambda each: _RANK.get(each["type"], 1))
    if details["type"] == "wrong_value":
        return Complaint(details["ctx"]["key"], details["msg"])
    section, *inner = (str(step) for step in details["loc"])
    if not inner:
        return _wrong_section(section, document)
    # Inside a section of several kinds the location also names the member of the union.
    models = {model.__name__: model for model in SECTIONS[section]}
    model = models[inner[0]] if section in SWITCHES else SECTIONS[section][0]
    place = _innermost(model, inner[1:] if section in SWITCHES and len(inner) > 1 else inner)
    return Complaint(f"{section}.{place.dotted}", _wrong_key(section, place, details))


def _innermost(model: type[BaseModel], steps: Sequence[str]) -> _Place:
    """Follow a location through tables within tables, numbers of list entries, and names of members of unions."""
    place, tables = _Place(steps[0], steps[0], model), _tables(model.model_fields.get(steps[0]))
    entered = _only(tables)
    for step in steps[1:]:
        if step.isdecimal():
            place = place._replace(dotted=f"{place.dotted}[{step}]")
        elif step in tables:
            entered = tables[step]
        elif entered is not None and step.isidentifier():
            place, tables = _Place(f"{place.dotted}.{step}", step, entered), _tables(entered.model_fields.get(step))
            entered = _only(tables)
    return place


def _tables(field: FieldInfo | None) -> dict[str, type[Section]]:
    """Return the models that a field's value may be, or hold, by their names."""
    left: list[object] = [] if field is None else [field.annotation]
    found = {}
    while left:
        each = left.pop()
        if isinstance(each, type) and issubclass(each, Section):
            found[each.__name__] = each
        left += get_args(each)
    return found


def _only(tables: Mapping[str, type[Section]]) -> type[Section] | None:
    return next(iter(tables.values())) if len(tables) == 1 else None


def _wrong_section(section: str, document: Mapping[str, Any]) -> Complaint:
    if section not in SECTIONS:
        hint = nearest_key(section, {known: known for known in SECTIONS})
        return Complaint(section, f"unknown section or key{hint}")
    found = document.get(section, {})
    if not isinstance(found, dict):
        return Complaint(section, f"expected a section [{section}], found {_shown(found)}")
    # All else that can be wrong with a whole section is that it asks for no known kind.
    switch = SWITCHES[section]
    if switch.key in found:
        choices = ", ".join(f'"{word}"' for word in switch.models)
        sentence = f"expected one of {choices}, found {_found(found[switch.key], switch.models)}"
        return Complaint(f"{section}.{switch.key}", sentence)
    known = keys_of(section)
    unknown = next((key for key in found if key not in known), None)
    if unknown is not None:
        return Complaint(f"{section}.{unknown}", f"unknown key{nearest_key(unknown, known)}")
    if section == "source":
        return Complaint(section, 'expected shape = "..." or path = "...", found neither')
    return Complaint(section, f'expected {switch.key} = "...", found none')


def _wrong_key(section: str, place: _Place, details: ErrorDetails) -> str:
    key, model = place.key, place.model
    if details["type"] == "extra_forbidden":
        if model not in SECTIONS[section]:
            return f"unknown key{nearest_key(key, {name: name for name in model.model_fields})}"
        known = keys_of(section)
        return _foreign_key(section, key, model) if key in known else f"unknown key{nearest_key(key, known)}"
    if details["type"] == "value_error":
        return str(details["ctx"]["error"])
    field = model.model_fields[key]
    if details["type"] == "missing":
        return f"expected {expectation(field)}, found nothing"
    choices = get_args(field.annotation) if get_origin(field.annotation) is Literal else ()
    return f"expected {expectation(field)}, found {_found(details['input'], choices)}"


def _foreign_key(section: str, key: str, model: type[BaseModel]) -> str:
    """Say whose key this is: it stands beside a shape, a path or a kind that has no such key."""
    if key == "shape":
        return "expected either shape or path, not both: remove one of them"
    switch = SWITCHES[section]
    owners = " or ".join(f'"{word}"' for word, owner in switch.models.items() if key in owner.model_fields)
    own = ", ".join(name for name in model.model_fields if name != switch.key)
    return f"belongs to {switch.key} = {owners}; the keys here are {own}"


def _found(value: object, choices: Iterable[str]) -> str:
    """Return a value, and a hint at the choice most like it when one is."""
    close = get_close_matches(str(value).lower(), choices, n=1)
    return _shown(value) + (f'; did you mean "{close[0]}"?' if close else "")


def _shown(value: object) -> str:
    """Return a value about as TOML shows it, cut to a length that can be read."""
    text = json.dumps(value, ensure_ascii=False, default=str)
    return text if len(text) <= 80 else text[:77] + "..."
