"""Locks: a colour and one place each."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from pydantic import ValidationError

from fabricate.config import Config, LockConfig, SideConfig
from fabricate.errors import ConfigError

Read = Callable[..., Config]
BALL = '[source]\nshape = "sphere"\n'


def test_locks_are_read_in_their_order(read: Read) -> None:
    text = BALL + (
        '[[pattern.locks]]\njoined = "yellow"\ntiles = [4, 5]\n'
        '[[pattern.locks]]\njoined = "blue"\nnear = ["0 mm", "0 mm", "5 cm"]\nwithin = "8 mm"\nhold = "most"\n'
        '[[pattern.locks]]\njoined = "blue"\n'
        'side = { point = ["0 mm", "0 mm", "1 mm"], normal = [0, 0, 1] }\n'
    )
    assert read(text).pattern.locks == (
        LockConfig(joined="yellow", tiles=(4, 5)),
        LockConfig(joined="blue", near=(0.0, 0.0, 50.0), within=8.0, hold="most"),
        LockConfig(joined="blue", side=SideConfig(point=(0.0, 0.0, 1.0), normal=(0.0, 0.0, 1.0))),
    )


@pytest.mark.parametrize(
    "place",
    [
        {},
        {"near": (0.0, 0.0, 0.0)},
        {"within": 3.0},
        {"tiles": (1,), "within": 3.0},
        {"tiles": (1,), "near": (0.0, 0.0, 0.0), "within": 3.0},
    ],
)
def test_a_lock_has_one_place(place: dict[str, object]) -> None:
    with pytest.raises(ValidationError, match="expected one of tiles, near with within, or side"):
        LockConfig.model_validate({"joined": "yellow", **place})


def test_locks_can_be_set(read: Read) -> None:
    setting = 'pattern.locks=[{ joined = "yellow", tiles = [1] }]'
    assert read(BALL, setting).pattern.locks == (LockConfig(joined="yellow", tiles=(1,)),)
    with pytest.raises(ConfigError, match=r'^--set: pattern\.locks\[0\]\.joined: .* found "green"'):
        read(BALL, setting.replace("yellow", "green"))


def test_no_locks_are_none(read: Read) -> None:
    assert read(BALL).pattern.locks is None
