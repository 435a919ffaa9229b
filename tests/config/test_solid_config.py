"""The parts have walls and triangles of some size; a gap may be none."""

import pytest
from pydantic import ValidationError

from fabricate.config import SolidConfig


def test_a_two_colour_job_has_no_gap() -> None:
    assert SolidConfig(clearance=0.0).clearance == 0.0


@pytest.mark.parametrize("keys", [{"thickness": 0.0}, {"tolerance": 0.0}, {"clearance": -0.1}, {"core": "red"}])
def test_walls_triangles_and_gaps_that_cannot_be_are_refused(keys: dict[str, object]) -> None:
    with pytest.raises(ValidationError):
        SolidConfig.model_validate(keys)
