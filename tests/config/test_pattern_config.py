"""The pattern is as fine as tile_size or levels says, and shared out as arc, rings or area_share does, never two."""

import pytest
from pydantic import ValidationError

from fabricate.config import PatternConfig


def test_levels_take_the_place_of_the_tile_size() -> None:
    assert PatternConfig().tile_size == 7.0
    pattern = PatternConfig(levels=0)
    assert (pattern.levels, pattern.tile_size) == (0, None)


@pytest.mark.parametrize("keys", [{"levels": 2, "tile_size": 7.0}, {"levels": None}, {"tile_size": None}])
def test_it_is_one_of_two(keys: dict[str, float | None]) -> None:
    with pytest.raises(ValidationError, match="either tile_size or levels, not both"):
        PatternConfig.model_validate(keys)


def test_an_area_share_takes_the_place_of_the_arc() -> None:
    assert PatternConfig().arc == 0.5
    pattern = PatternConfig(area_share=0.6)
    assert (pattern.area_share, pattern.arc) == (0.6, None)


@pytest.mark.parametrize("arc", [0.293, 0.707])
def test_opposite_arcs_of_a_tile_do_not_meet(arc: float) -> None:
    with pytest.raises(ValidationError):
        PatternConfig(arc=arc)


def test_rings_take_the_place_of_the_arc() -> None:
    assert PatternConfig().positions == (0.5,)
    assert PatternConfig(arc=0.4).positions == (0.4,)
    pattern = PatternConfig.model_validate({"rings": [0.4, 0.6]})
    assert (pattern.arc, pattern.positions) == (None, (0.4, 0.6))
    assert PatternConfig.model_validate({"rings": [0.4]}).positions == (0.4,)


@pytest.mark.parametrize(
    ("keys", "found"),
    [
        ({"rings": [0.4, 0.6], "arc": 0.5}, "arc and rings"),
        ({"arc": 0.5, "area_share": 0.6}, "arc and area_share"),
        ({"rings": "three", "area_share": 0.6}, "rings and area_share"),
        *(({key: None}, "none") for key in ("arc", "rings", "area_share")),
    ],
)
def test_it_is_one_of_three(keys: dict[str, object], found: str) -> None:
    with pytest.raises(ValidationError, match=f"one of arc, rings and area_share, found {found}: keep one"):
        PatternConfig.model_validate(keys)
