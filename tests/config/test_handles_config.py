"""Handles are shared evenly or counted for yellow."""

import pytest
from pydantic import ValidationError

from fabricate.config import PatternConfig
from fabricate.config.handles_config import HandlesConfig, handles_of_yellow


def test_yellow_has_none_unless_asked() -> None:
    assert handles_of_yellow(PatternConfig().handles, 3) == 0


@pytest.mark.parametrize(("genus", "yellow"), [(0, 0), (1, 0), (2, 1), (3, 1), (6, 3)])
def test_blue_gets_the_odd_one(genus: int, yellow: int) -> None:
    assert handles_of_yellow(PatternConfig(handles="even").handles, genus) == yellow


def test_a_number_is_taken_as_it_is() -> None:
    assert handles_of_yellow(PatternConfig.model_validate({"handles": {"yellow": 4}}).handles, 3) == 4


@pytest.mark.parametrize("handles", [{"yellow": -1}, {"yellow": 1.5}, {"blue": 1}, 2, "odd"])
def test_what_is_no_number_of_handles_is_refused(handles: object) -> None:
    with pytest.raises(ValidationError):
        PatternConfig.model_validate({"handles": handles})
    assert HandlesConfig(yellow=2).yellow == 2
