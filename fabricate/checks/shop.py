"""The print shop's gate: whether finished parts are what it accepts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from fabricate.checks.check import Check
from fabricate.checks.facts import PartFacts
from fabricate.checks.walls import Walls
from fabricate.checks.wording import told_apart
from fabricate.config import ShopConfig
from fabricate.solid.part import Part

HEADER, RECORD = 84, 50
"""Bytes of a binary STL file, and of each triangle in it."""

MEGABYTE = 1 << 20


def most_polygons(shop: ShopConfig) -> int | None:
    """Return how many triangles one file may have, by the shop's limits of polygons and of file size."""
    by_size = None if shop.file_mb is None else max(0, (int(shop.file_mb * MEGABYTE) - HEADER) // RECORD)
    return min((limit for limit in (shop.polygons, by_size) if limit is not None), default=None)


def polygons_wording(shop: ShopConfig) -> str:
    """Return how many triangles the shop accepts in a file, and which key says so."""
    most = most_polygons(shop)
    if shop.file_mb is None or most == shop.polygons:
        return f"process.shop.polygons accepts {most}"
    return f"process.shop.file_mb, {shop.file_mb:g} MB, has room for {most}"


def shop_checks(
    parts: Sequence[Part], facts: Mapping[str, PartFacts], walls: Mapping[str, Walls], shop: ShopConfig | None
) -> tuple[Check, ...]:
    """Check parts against each limit that the shop has; `facts` and `walls` are by the parts' names."""
    if shop is None:
        return ()
    checks = []
    if shop.polygons is not None:
        checks.append(_polygons_check(parts, shop.polygons))
    if shop.file_mb is not None:
        checks.append(_file_check(parts, shop.file_mb))
    if shop.box is not None:
        checks.append(_box_check(parts, shop.box))
    if shop.wall is not None:
        checks += [_wall_check(part.name, facts[part.name], walls[part.name], shop.wall) for part in parts]
    return tuple(checks)


def _polygons_check(parts: Sequence[Part], most: int) -> Check:
    largest = max(parts, key=lambda part: len(part.triangles))
    count = len(largest.triangles)
    message = f"the shop accepts {most} polygons in a file, and {largest.name} has {count}"
    return Check("shop.polygons", ok=count <= most, message=message)


def _file_check(parts: Sequence[Part], most: float) -> Check:
    largest = max(parts, key=lambda part: len(part.triangles))
    size = (HEADER + RECORD * len(largest.triangles)) / MEGABYTE
    message = f"the shop accepts files of {most:g} MB, and {largest.name}.stl has {size:.6g} MB"
    return Check("shop.file", ok=size <= most, message=message)


def _box_check(parts: Sequence[Part], box: tuple[float, float, float]) -> Check:
    points = np.concatenate([part.points for part in parts])
    sides = np.ptp(points, axis=0) if len(points) else np.zeros(3)
    message = (
        f"the shop accepts a bounding box of {_sides(box)} mm, turned or not, and the parts take {_sides(sides)} mm"
    )
    return Check("shop.box", ok=bool((np.sort(sides) <= np.sort(box)).all()), message=message)


def _sides(box: Sequence[float] | np.ndarray) -> str:
    return " x ".join(f"{side:.6g}" for side in box)


def _wall_check(name: str, facts: PartFacts, walls: Walls, thinnest: float) -> Check:
    code = f"shop.wall.{name}"
    if facts.wall_mm is None:
        message = f"{name} has no opposite faces to measure a wall between"
        return Check(code, ok=False, skipped=True, message=message)
    ok = not facts.wall_mm.min < thinnest
    found = told_apart(facts.wall_mm.min, thinnest)
    message = f"the shop accepts walls of {thinnest:g} mm, and the thinnest of {name} has {found} mm"
    return Check(
        code, ok=ok, message=message, where=walls.places[:1] if ok else walls.places[walls.thickness < thinnest]
    )
