"""The pattern is as fine as either tile_size or levels says, never both."""

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


@pytest.mark.parametrize("arc", [0.293, 0.707])
def test_opposite_arcs_of_a_tile_do_not_meet(arc: float) -> None:
    with pytest.raises(ValidationError):
        PatternConfig(arc=arc)
