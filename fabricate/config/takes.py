"""What a key takes, in words, where its type does not say it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Takes:
    """Words for messages and comments, such as "three lengths": metadata of an annotated type."""

    words: str
