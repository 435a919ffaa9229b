"""Rings: designs by name, and positions that increase within bounds."""

from __future__ import annotations

from itertools import pairwise

import pytest
from pydantic import TypeAdapter, ValidationError

from fabricate.config.ring_positions import RING_DESIGNS, Rings
from fabricate.surface.template import ARC_MAX, ARC_MIN, tile_template

ADAPTER: TypeAdapter[tuple[float, ...]] = TypeAdapter(Rings)


@pytest.mark.parametrize(("name", "regions"), [("two", 2), ("three", 3), ("four", 4)])
def test_designs_make_as_many_regions_as_their_names_say(name: str, regions: int) -> None:
    rings = RING_DESIGNS[name]  # type: ignore[index]
    assert ADAPTER.validate_python(list(rings)) == rings
    template = tile_template(rings=rings, resolution=4, yellow_joined=True)
    assert sorted(set(template.regions.tolist())) == list(range(regions))


def test_designs_leave_room_for_every_region() -> None:
    for rings in RING_DESIGNS.values():
        widths = [2**0.5 - 2 * max(rings[-1], 1 - rings[0]), *(outer - inner for inner, outer in pairwise(rings))]
        assert min(widths) > 0.08


@pytest.mark.parametrize(
    ("rings", "words"),
    [
        ([], "expected one position or more, found none"),
        ([0.4, 0.4], "expected positions that increase, found 0.4 after 0.4"),
        ([0.6, 0.4], "expected positions that increase, found 0.4 after 0.6"),
        ([0.29, 0.5], "between 0.293 and 0.707, found 0.29"),
        ([0.5, 0.707], "between 0.293 and 0.707, found 0.707"),
    ],
)
def test_wrong_positions_are_said(rings: list[float], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        ADAPTER.validate_python(rings)


def test_what_is_allowed_has_arcs_that_do_not_meet() -> None:
    for ring in (0.29300001, 0.70699999):
        assert ADAPTER.validate_python([ring]) == (ring,)
        assert ARC_MIN < ring < ARC_MAX
