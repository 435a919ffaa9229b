"""What a key takes, in words: for complaints and for the comments of a new config."""

from __future__ import annotations

from types import NoneType, UnionType
from typing import Literal, NamedTuple, TypeGuard, Union, get_args, get_origin

from pydantic import BeforeValidator, PlainSerializer
from pydantic.fields import FieldInfo

from fabricate.config.section import Section
from fabricate.config.takes import Takes
from fabricate.units import format_angle, format_length

_BOUNDS = {"ge": "at least", "gt": "more than", "le": "at most", "lt": "less than"}


def expectation(field: FieldInfo) -> str:
    """Return in words what a field takes, such as "a whole number, at least 1, at most 32"."""
    words, present, table = _alternatives(field)
    if get_origin(present.annotation) is Literal:
        return "one of " + ", ".join(f'"{choice}"' for choice in get_args(present.annotation))
    named = [fact.words for fact in present.metadata if isinstance(fact, Takes)]
    is_length = not named and any(isinstance(fact, BeforeValidator) for fact in present.metadata)
    is_angle = any(isinstance(fact, PlainSerializer) and fact.func is format_angle for fact in present.metadata)
    kinds: dict[object, str] = {str: "text", bool: "true or false", int: "a whole number", float: "a number"}
    show = format_angle if is_angle else format_length if is_length else "{:.15g}".format
    bounds = (
        f"{words} {show(getattr(fact, bound))}"
        for fact in present.metadata
        for bound, words in _BOUNDS.items()
        if hasattr(fact, bound)
    )
    if named:
        kind = named[0]
    elif _is_table(present.annotation):
        kind = _table(present.annotation)
    else:
        kind = "an angle" if is_angle else "a length" if is_length else kinds[present.annotation]
    text = ", ".join([*(f'"{word}"' for word in words), kind, *bounds]).replace('", a', '" or a', 1)
    return text if table is None else f"{text}, or {_table(table)}"


class _Alternatives(NamedTuple):
    """What a field takes: words, another value as the field that takes only that, and a table instead."""

    words: tuple[str, ...]
    other: FieldInfo
    table: type[Section] | None


def _alternatives(field: FieldInfo) -> _Alternatives:
    """Return the words and the table that a field takes beside another value; TOML has no null, so None is no value."""
    if get_origin(field.annotation) not in {Union, UnionType}:
        return _Alternatives((), field, None)
    members = [member for member in get_args(field.annotation) if member is not NoneType]
    words = tuple(word for member in members if get_origin(member) is Literal for word in get_args(member))
    others = [FieldInfo.from_annotation(member) for member in members if get_origin(member) is not Literal]
    plain = [other for other in others if not _is_table(other.annotation)]
    tables = [model for other in others if plain and _is_table(model := other.annotation)]
    (other,) = plain or others
    return _Alternatives(words, other, tables[0] if tables else None)


def _is_table(annotation: object) -> TypeGuard[type[Section]]:
    return isinstance(annotation, type) and issubclass(annotation, Section)


def _table(model: type[Section]) -> str:
    return f"a table of {', '.join(model.model_fields)}"
