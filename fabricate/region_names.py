"""The names of regions, which their parts, files and entries in the report have too."""

from __future__ import annotations


def region_names(count: int) -> tuple[str, ...]:
    """Return the names of two regions or more, in their order: "yellow", "band-1", "band-2", ..., "blue"."""
    return "yellow", *(f"band-{number}" for number in range(1, count - 1)), "blue"
