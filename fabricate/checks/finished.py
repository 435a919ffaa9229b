"""Openings and a stand in the report, and what they change of what the parts are expected to be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from fabricate.arrays import Floats
from fabricate.checks.expectations import Expectations
from fabricate.checks.facts import BaseFacts, FinishFacts, OpeningFacts, Spaces, Xyz
from fabricate.checks.geometry import signed_volume
from fabricate.solid.finish import Finished


def finish_facts(finished: Finished) -> FinishFacts:
    """Return what is known of the openings and the stand."""
    openings = tuple(
        OpeningFacts(opening.part, opening.diameter, _xyz(opening.at), _xyz(opening.way))
        for opening in finished.openings
    )
    stand = finished.stand
    if stand is None:
        return FinishFacts(openings, None)
    return FinishFacts(openings, BaseFacts(stand.part, stand.height, 2.0 * stand.plate.radius, len(stand.feet)))


def with_handles(genus: Mapping[str, int], finish: FinishFacts) -> dict[str, int]:
    """Return the handles of each part, by name, with those of the finish.

    Each opening is one, and each foot but the first, which closes a loop through the plate and the part.
    """
    more = [opening.part for opening in finish.openings]
    if finish.base is not None:
        more += [finish.base.part] * (finish.base.feet - 1)
    return {part: handles + more.count(part) for part, handles in genus.items()}


def with_finish(wanted: Expectations, finished: Finished) -> Expectations:
    """Return what is expected of the parts with their openings and their stand."""
    genus = with_handles(wanted.genus, finish_facts(finished))
    return replace(wanted, genus=genus, spaces=Spaces(*map(signed_volume, finished.spaces)))


def _xyz(point: Floats) -> Xyz:
    x, y, z = (float(value) for value in point)
    return x, y, z
