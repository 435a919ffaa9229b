"""The print shop's gate: each limit met to the last triangle, and just missed."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from fabricate.checks.check import Check
from fabricate.checks.expectations import Expectations
from fabricate.checks.judge import judged_parts
from fabricate.checks.shop import HEADER, MEGABYTE, RECORD, most_polygons, polygons_wording
from fabricate.config import ShopConfig
from fabricate.solid.part import Part


def box(name: str, sides: tuple[float, float, float], x: float) -> Part:
    mesh = trimesh.creation.box(sides)
    return Part(name, mesh.vertices + np.array([x, 0, 0]), mesh.faces)


RED, BLUE = box("red", (2, 10, 20), 0.0), box("blue", (3, 10, 20), 5.0)
WHOLE = (2 / 2 + 5 + 3 / 2, 10.0, 20.0)


def shop_checks(shop: ShopConfig | None) -> dict[str, Check]:
    found = judged_parts([RED, BLUE], Expectations(shop=shop))
    return {check.code: check for check in found.checks if check.code.startswith("shop.")}


def many(count: int) -> Part:
    """Return a part of at least so many triangles."""
    ball = trimesh.creation.icosphere(subdivisions=3)
    assert len(ball.faces) >= count
    return Part("ball", ball.vertices, ball.faces)


def test_without_a_shop_there_are_no_limits() -> None:
    assert shop_checks(None) == {}


def test_only_limits_that_a_shop_has_are_checked() -> None:
    assert set(shop_checks(ShopConfig(polygons=1000))) == {"shop.polygons"}
    assert set(shop_checks(ShopConfig(wall=1.0))) == {"shop.wall.red", "shop.wall.blue"}


@pytest.mark.parametrize(("most", "ok"), [(1280, True), (1279, False)])
def test_polygons_are_counted(most: int, ok: bool) -> None:
    ball = many(1280)
    (check,) = [
        c for c in judged_parts([ball], Expectations(shop=ShopConfig(polygons=most))).checks if "shop" in c.code
    ]
    assert (check.code, check.ok, check.skipped) == ("shop.polygons", ok, False)
    assert "1280" in check.message


@pytest.mark.parametrize("missing", [0, 1])
def test_a_file_may_be_as_large_as_the_shop_says(missing: int) -> None:
    size = HEADER + 12 * RECORD - missing
    assert shop_checks(ShopConfig(file_mb=size / MEGABYTE))["shop.file"].ok == (not missing)
    assert most_polygons(ShopConfig(file_mb=size / MEGABYTE)) == 12 - missing


def test_parts_may_be_turned_into_the_box() -> None:
    assert shop_checks(ShopConfig(box=(20.0, WHOLE[0], 10.0)))["shop.box"].ok
    assert shop_checks(ShopConfig(box=(19.999, 15.0, 15.0)))["shop.box"].failed


def test_thin_walls_are_named_with_their_places() -> None:
    found = shop_checks(ShopConfig(wall=2.5))
    assert found["shop.wall.blue"].ok
    thin = found["shop.wall.red"]
    assert thin.failed
    assert np.abs(thin.where[:, 0]) == pytest.approx(1.0)


def test_the_tighter_of_two_limits_counts() -> None:
    assert most_polygons(ShopConfig(polygons=5000, file_mb=1.0)) == 5000
    assert most_polygons(ShopConfig(polygons=50_000, file_mb=1.0)) == (MEGABYTE - HEADER) // RECORD
    assert most_polygons(ShopConfig(wall=1.0)) is None


def test_the_key_that_limits_polygons_is_named() -> None:
    assert polygons_wording(ShopConfig(polygons=5000, file_mb=1.0)) == "process.shop.polygons accepts 5000"
    assert polygons_wording(ShopConfig(polygons=50_000, file_mb=1.0)).startswith("process.shop.file_mb, 1 MB, has room")
    assert polygons_wording(ShopConfig(file_mb=1e-6)) == "process.shop.file_mb, 1e-06 MB, has room for 0"
