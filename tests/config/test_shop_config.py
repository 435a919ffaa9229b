"""The table process.shop: its limits, and what is no limit."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from fabricate.config import Config, ShopConfig
from fabricate.config.resolved import resolved_toml
from fabricate.errors import ConfigError

CUBE = '[source]\nshape = "cube"\n[process]\n'


def test_limits_are_read_and_come_back(read: Callable[..., Config]) -> None:
    text = 'shop = { polygons = 50000, file_mb = 64, box = ["10 cm", "80 mm", "7 cm"], wall = "1 mm" }'
    config = read(CUBE + text)
    assert config.process.shop == ShopConfig(polygons=50_000, file_mb=64.0, box=(100.0, 80.0, 70.0), wall=1.0)
    assert read(resolved_toml(config)) == config


def test_there_are_none_unless_given(read: Callable[..., Config]) -> None:
    assert read(CUBE).process.shop is None
    assert read(CUBE + 'shop = { wall = "1 mm" }').process.shop == ShopConfig(wall=1.0)


@pytest.mark.parametrize(
    ("table", "complaint"),
    [
        ("{}", "at least one of polygons, file_mb, box, wall"),
        ("{ polygon = 5000 }", r"process.shop.polygon: unknown key; did you mean polygons\?"),
        ("{ polygons = 10 }", r"process.shop.polygons: expected a whole number, at least 1000"),
        ('{ box = ["1 mm", "2 mm", "0 mm"] }', r"process.shop.box: expected three lengths of more than 0 mm"),
        ('{ box = ["1 mm", "2 mm"] }', r"process.shop.box.*expected three lengths"),
        ('{ wall = "0 mm" }', r"process.shop.wall: expected a length, more than 0 mm"),
        ("3", r"process.shop: expected a table of polygons, file_mb, box, wall"),
    ],
)
def test_what_is_no_limit_is_one_line(read: Callable[..., Config], table: str, complaint: str) -> None:
    with pytest.raises(ConfigError, match=complaint):
        read(f"{CUBE}shop = {table}")
