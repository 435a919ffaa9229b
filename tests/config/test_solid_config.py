"""The parts have walls and triangles of some size; a gap may be none."""

import pytest
from pydantic import ValidationError

from fabricate.config import SolidConfig, ThicknessConfig


def test_a_two_colour_job_has_no_gap() -> None:
    assert SolidConfig(clearance=0.0).clearance == 0.0


def test_a_thickness_may_vary() -> None:
    varying = SolidConfig.model_validate({"thickness": {"min": 1.6, "max": 3.0, "by": "height"}})
    assert varying.thickness == ThicknessConfig(min=1.6, max=3.0, by="height")
    assert varying.thickness_range == (1.6, 3.0)
    assert SolidConfig(thickness=2.0).thickness_range == (2.0, 2.0)


@pytest.mark.parametrize("keys", [{"thickness": 0.0}, {"tolerance": 0.0}, {"clearance": -0.1}, {"core": "red"}])
def test_walls_triangles_and_gaps_that_cannot_be_are_refused(keys: dict[str, object]) -> None:
    with pytest.raises(ValidationError):
        SolidConfig.model_validate(keys)
