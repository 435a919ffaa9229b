"""What a key takes, in words: for complaints and for the comments of a new config."""

from __future__ import annotations

from types import NoneType
from typing import Literal, get_args, get_origin

from pydantic import BeforeValidator
from pydantic.fields import FieldInfo

from fabricate.units import format_length

_BOUNDS = {"ge": "at least", "gt": "more than", "le": "at most", "lt": "less than"}


def expectation(field: FieldInfo) -> str:
    """Return in words what a field takes, such as "a whole number, at least 1, at most 32"."""
    present = _without_none(field)
    if get_origin(present.annotation) is Literal:
        return "one of " + ", ".join(f'"{choice}"' for choice in get_args(present.annotation))
    is_length = any(isinstance(fact, BeforeValidator) for fact in present.metadata)
    kinds: dict[object, str] = {str: "text", int: "a whole number", float: "a number"}
    show = format_length if is_length else "{:g}".format
    bounds = (
        f"{words} {show(getattr(fact, bound))}"
        for fact in present.metadata
        for bound, words in _BOUNDS.items()
        if hasattr(fact, bound)
    )
    return ", ".join(["a length" if is_length else kinds[present.annotation], *bounds])


def _without_none(field: FieldInfo) -> FieldInfo:
    """Return the field as it is when a value is given: TOML has no null."""
    members = get_args(field.annotation)
    return FieldInfo.from_annotation(members[0]) if NoneType in members else field
