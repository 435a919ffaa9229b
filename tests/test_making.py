"""Making: parts within a limit of polygons, with all that is added to them, or a refusal that says what would do."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from fabricate.checks.check import Check
from fabricate.checks.judge import judged_parts
from fabricate.config import Config
from fabricate.config.section import ConfigFolder
from fabricate.dividing import divided, read_bodies
from fabricate.errors import SolidError
from fabricate.making import Made, check_fine_enough, made, wanted
from fabricate.prepare.store import NOTHING_KEPT
from fabricate.solid.polygon_budget import largest_part

TOO_WIDE = Check("fit.gap_max", ok=False, message="the gap is too wide; do something")


def config(rest: str = "") -> Config:
    text = (
        '[source]\nshape = "sphere"\nfrequency = 1\nsize = "50 mm"\n[pattern]\ntile_size = "22 mm"\n'
        '[solid]\nthickness = "2 mm"\ntolerance = "0.1 mm"\n'
    )
    return Config.model_validate(tomllib.loads(text + rest), context=ConfigFolder(Path()))


def parts_of(asked: Config) -> Made:
    (body,) = read_bodies(asked, name="ball", progress=lambda _: None, store=NOTHING_KEPT)
    return made(divided(body, asked, store=NOTHING_KEPT), asked)


def test_a_stand_is_counted() -> None:
    stand = 'base = { height = "3 mm" }\n'
    free = parts_of(config(stand))
    budget = largest_part(free.surface, core="hollow")
    assert budget < free.largest
    found = parts_of(config(f"{stand}[process]\nshop = {{ polygons = {budget} }}"))
    assert found.largest <= budget
    assert found.divided.fitting.tolerance > free.divided.fitting.tolerance


def test_coarse_parts_that_finer_ones_are_better_than_are_refused() -> None:
    asked = config("[process]\nshop = { polygons = 15000 }")
    coarse = parts_of(asked)
    assert coarse.largest <= 15000
    with pytest.raises(
        SolidError, match=r"polygons accepts 15000 .* fail fit.gap_max: the gap is too wide; "
    ) as caught:
        check_fine_enough(coarse, asked, (TOO_WIDE,))
    assert "\n" not in str(caught.value)
    check_fine_enough(coarse, asked, ())


def test_what_finer_parts_fail_as_well_is_no_reason_to_refuse() -> None:
    asked = config('[process]\nshop = { polygons = 15000, wall = "9 mm" }')
    coarse = parts_of(asked)
    checks = judged_parts(coarse.ready.parts, wanted(coarse, asked)).checks
    assert {check.code for check in checks if check.failed} >= {"shop.wall.yellow", "shop.wall.blue"}
    check_fine_enough(coarse, asked, checks)


def test_parts_as_fine_as_asked_for_are_not_refused() -> None:
    asked = config()
    check_fine_enough(parts_of(asked), asked, (TOO_WIDE,))


def test_the_key_that_no_division_satisfies_is_named() -> None:
    with pytest.raises(SolidError, match=r"however coarsely .*process\.shop\.file_mb, 1e-06 MB, has room for 0"):
        parts_of(config("[process]\nshop = { file_mb = 0.000001 }"))
