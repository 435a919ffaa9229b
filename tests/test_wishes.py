from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from fabricate.config import Config
from fabricate.config.section import ConfigFolder
from fabricate.errors import FabricateError
from fabricate.mesh.cube import cube
from fabricate.prepare.prepared import Prepared
from fabricate.process import PROCESSES
from fabricate.wishes import curve_wish, expected_rings, finish_wish, in_place, joint_wish, tile_wish

BODY = Prepared(cube(divisions=1), (), ())


def config(text: str = "", *, pattern: str = 'tile_size = "7 mm"') -> Config:
    whole = f'[source]\nshape = "cube"\nsize = "60 mm"\n[pattern]\n{pattern}\n{text}'
    return Config.model_validate(tomllib.loads(whole), context=ConfigFolder(Path()))


@pytest.mark.parametrize("name", list(PROCESSES))
def test_necks_are_asked_for_as_wide_as_the_process_and_the_gap_need(name: str) -> None:
    wish, limit = tile_wish(config(f'[process]\nname = "{name}"\n[solid]\nclearance = "0.4 mm"'), BODY)
    assert wish.neck > PROCESSES[name].feature_min + 0.4
    assert wish.tile_size == 7.0
    assert limit == ()


def test_a_free_tile_size_says_what_bound_it() -> None:
    wish, (limit,) = tile_wish(config(pattern='tile_size = "auto"'), BODY)
    assert wish.resized
    assert wish.tile_size is not None
    assert f"{wish.tile_size:.3g}" in limit


def test_tiles_without_room_for_the_gap_are_refused() -> None:
    with pytest.raises(FabricateError, match="tile"):
        tile_wish(config('[solid]\nclearance = "2 mm"', pattern='tile_size = "1 mm"'), BODY)


def test_the_ring_of_an_area_share_is_on_its_side_of_the_middle() -> None:
    (small,) = expected_rings(config(pattern='tile_size = "7 mm"\narea_share = 0.3').pattern)
    (large,) = expected_rings(config(pattern='tile_size = "7 mm"\narea_share = 0.7').pattern)
    assert small < 0.5 < large
    assert small + large == pytest.approx(1.0)


def test_a_curve_without_a_field_is_the_same_in_every_place() -> None:
    asked = config()
    wish = curve_wish(asked, None, genus=0, neck=1.0, depth=2.0)
    assert in_place(wish, BODY, tile_wish(asked, BODY)[0]) is wish
    assert (wish.seed, wish.tree) == (asked.pattern.seed, asked.pattern.tree)


def test_what_a_joint_leaves_open_is_none() -> None:
    free = joint_wish(config('[solid]\njoint = "tongue"'))
    assert (free.kind, free.angle, free.height, free.width) == ("tongue", None, None, None)
    bound = joint_wish(config('[solid]\njoint = "draft"\ndraft = "2 deg"'))
    assert (bound.kind, bound.angle) == ("draft", pytest.approx(2.0))


def test_openings_and_stand_are_none_unless_asked_for() -> None:
    plain = finish_wish(config())
    assert (plain.opening_count, plain.stand_height) == (0, 0.0)
    asked = '[solid]\nopenings = {diameter = "3 mm", count = 2}\nbase = {height = "4 mm"}'
    wish = finish_wish(config(asked))
    assert (wish.opening_diameter, wish.opening_count, wish.stand_height) == (3.0, 2, 4.0)
