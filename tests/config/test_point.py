"""Points are three lengths, directions three numbers that are not all zero."""

from pathlib import Path

import pytest
from pydantic import TypeAdapter, ValidationError

from fabricate.config.point import Direction, Point
from fabricate.config.section import ConfigFolder

POINT, DIRECTION = TypeAdapter(Point), TypeAdapter(Direction)
FILE = ConfigFolder(Path())


def test_a_point_is_read_in_mm_and_written_with_units() -> None:
    assert POINT.validate_python(["1 cm", "-2 mm", "1 in"], context=FILE) == (10.0, -2.0, 25.4)
    assert POINT.dump_python((10.0, -2.0, 25.4), mode="json") == ["10 mm", "-2 mm", "25.4 mm"]


@pytest.mark.parametrize("wrong", [["1 mm", "2 mm"], [1, 2, 3], "1 mm", 4.0, []])
def test_what_is_no_point_is_refused(wrong: object) -> None:
    with pytest.raises(ValidationError):
        POINT.validate_python(wrong, context=FILE)


def test_a_direction_is_not_zero() -> None:
    assert DIRECTION.validate_python([0, 0, 2]) == (0.0, 0.0, 2.0)
    with pytest.raises(ValidationError, match="three zeros"):
        DIRECTION.validate_python([0, 0, 0])
