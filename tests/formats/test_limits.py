"""Limits: what fits is let through, one more is refused, and the message names the key that raises the limit."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits

LIMITS = ReadLimits(max_bytes=3 << 20, max_faces=10)

Check = Callable[[ReadLimits, int], None]


@pytest.mark.parametrize(
    ("check", "most", "key"),
    [
        (ReadLimits.check_bytes, 3 << 20, "prepare.max_file_mb"),
        (ReadLimits.check_faces, 10, "prepare.max_faces"),
        (ReadLimits.check_points, 30, "prepare.max_faces"),
        (ReadLimits.check_numbers, 240, "prepare.max_faces"),
    ],
)
def test_one_more_than_allowed_is_refused(check: Check, most: int, key: str) -> None:
    check(LIMITS, most)
    with pytest.raises(ReadError, match=key) as caught:
        check(LIMITS, most + 1)
    assert "\n" not in str(caught.value)


def test_sizes_are_given_in_megabytes_and_say_of_what() -> None:
    with pytest.raises(ReadError, match=r"at most 3 MB are read, but the model inside has 4\.5 MB"):
        LIMITS.check_bytes(9 << 19, what="the model inside")


def test_defaults_leave_room_for_soup_and_for_scans_with_colours() -> None:
    faces = DEFAULT_LIMITS.max_faces
    DEFAULT_LIMITS.check_points(3 * faces)
    DEFAULT_LIMITS.check_numbers(faces // 2 * 20 + 4 * faces)
