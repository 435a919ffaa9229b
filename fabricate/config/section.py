"""What the sections of a config have in common: how strictly they are read, and what they know meanwhile."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from pydantic import BaseModel, ConfigDict
from pydantic_core import PydanticCustomError


@dataclass(frozen=True)
class ConfigFolder:
    """Validation context of a config that comes from a file: where it lies, and that lengths carry units."""

    path: Path


class Section(BaseModel):
    """Base of all sections: only known keys, each of exactly its type, and nothing is edited afterwards."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", strict=True, allow_inf_nan=False, use_attribute_docstrings=True
    )


def wrong_value(key: str, message: str) -> PydanticCustomError:
    """Return the error that a validator raises to blame a dotted key, with the whole sentence to be shown."""
    return PydanticCustomError("wrong_value", "{message}", {"key": key, "message": message})
