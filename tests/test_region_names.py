"""Names of regions, in their order."""

from __future__ import annotations

from fabricate.region_names import region_names


def test_bands_are_numbered_from_yellow_to_blue() -> None:
    assert region_names(2) == ("yellow", "blue")
    assert region_names(3) == ("yellow", "band-1", "blue")
    assert region_names(5) == ("yellow", "band-1", "band-2", "band-3", "blue")
