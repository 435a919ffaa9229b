"""Judging how parts go together: each pair of them, and all of them as a whole."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from types import MappingProxyType

import numpy as np
from manifold3d import Manifold
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fabricate.checks.check import Check
from fabricate.checks.contacts import REACH, TOUCHING, Facing, shared_area
from fabricate.checks.expectations import Expectations
from fabricate.checks.facts import FitFacts, Gap, PairFacts, Verdict
from fabricate.checks.fit import OVERLAP_SHARE, gap_check, overlap_check, widest_gap_check
from fabricate.checks.gap import Spacing, smallest_gap, widest_gap
from fabricate.checks.holding import Holding, holding, holding_check
from fabricate.checks.wording import counted
from fabricate.solid.part import Part
from fabricate.triangles.search_tree import SearchTree

UNKNOWN = PairFacts(gap_mm=None, overlap_mm3=None, verdict=None, play_mm=None, witness=None)
"""Facts of two parts that could not be measured."""


@dataclass(frozen=True, eq=False)
class Solid:
    """A part that is a solid, as those who measure it hold it: built once, used for every pair."""

    part: Part
    manifold: Manifold
    tree: SearchTree


@dataclass(frozen=True, eq=False)
class Fit:
    """How parts go together, the checks of it, and the joints of each part, by name, with all others."""

    facts: FitFacts
    checks: tuple[Check, ...]
    joints: Mapping[str, Sequence[Facing]]


@dataclass(frozen=True, eq=False)
class _Pair:
    """How two parts go together; without a gap where one of them is no solid."""

    facts: PairFacts
    checks: tuple[Check, ...]
    joints: tuple[tuple[str, Facing], ...] = ()
    neighbours: bool = False

    @property
    def measured(self) -> bool:
        return self.facts.gap_mm is not None


def fit(parts: Sequence[Part], solids: Mapping[str, Solid], expectations: Expectations) -> Fit:
    """Find out and check how two or more parts go together; `solids` holds those that are solids, by name."""
    pairs: dict[str, _Pair] = {}
    for first, second in combinations(parts, 2):
        name = f"{first.name}-{second.name}"
        prefix = "fit" if len(parts) == 2 else f"fit.{name}"
        if first.name in solids and second.name in solids:
            between = solids[first.name], solids[second.name]
            pairs[name] = _pair(prefix, *between, expectations, only_pair=len(parts) == 2)
        else:
            pairs[name] = _unmeasured(prefix, first, second, spoiler=second if first.name in solids else first)
    checks = [check for pair in pairs.values() for check in pair.checks]
    measured = [pair.facts for pair in pairs.values() if pair.measured]
    facts = FitFacts(
        clearance_mm=expectations.clearance,
        gap_mm=min((pair.gap_mm for pair in measured if pair.gap_mm), key=lambda gap: gap.min, default=None),
        overlap_mm3=sum(pair.overlap_mm3 or 0.0 for pair in measured) if measured else None,
        verdict=_verdict(len(parts), list(pairs.values())),
        play_mm=measured[0].play_mm if len(parts) == 2 and measured else None,
        witness=measured[0].witness if len(parts) == 2 and measured else None,
        pairs=MappingProxyType({name: pair.facts for name, pair in pairs.items()}),
        spaces_mm3=expectations.spaces,
    )
    joined = _joined(parts, list(pairs.values()), expectations.clearance)
    return Fit(facts, (*checks, *joined), _joints(pairs.values()))


def _pair(prefix: str, first: Solid, second: Solid, expectations: Expectations, *, only_pair: bool) -> _Pair:
    clearance = expectations.clearance
    spacing = Spacing.between(first.tree, second.tree, clearance=clearance)
    gap = smallest_gap(spacing, first.manifold, second.manifold, clearance=clearance)
    # Manifold has intersected them already to find a gap, and found nothing.
    common = first.manifold ^ second.manifold if gap.min == 0.0 else Manifold()
    middles = expectations.middles.get(f"{first.part.name}-{second.part.name}")
    widest = None if middles is None else widest_gap(spacing, middles)
    gap = gap if widest is None else replace(gap, max=widest[0], max_at=widest[1])
    smaller = min(first.manifold.volume(), second.manifold.volume())
    neighbours = only_pair or middles is not None or clearance is None or gap.min <= REACH * clearance
    shared = shared_area(spacing) if gap.min <= TOUCHING else 0.0
    one = shared > 0.0 or common.volume() > OVERLAP_SHARE * smaller
    found = _holding(spacing, first, second, gap, clearance, one=one) if neighbours else None
    checks = [overlap_check(f"{prefix}.overlap", first.part, second.part, common, smaller_volume=smaller)]
    if neighbours or clearance != 0.0:
        checks.append(
            gap_check(
                f"{prefix}.gap",
                *(first.part, second.part, gap),
                clearance=clearance,
                shared=shared,
                common=common.volume(),
            )
        )
    if neighbours:
        checks.append(
            widest_gap_check(
                f"{prefix}.gap_max", first.part, second.part, gap, clearance=clearance, tolerance=expectations.tolerance
            )
        )
        checks.append(_moving(f"{prefix}.mobility", first.part, second.part, found, expectations))
    facts = PairFacts(
        gap_mm=gap,
        overlap_mm3=common.volume(),
        verdict=found.verdict if found else None,
        play_mm=found.play if found else None,
        witness=found.witness_facts if found else None,
    )
    facing = () if clearance is None else _facing(first, second, spacing, clearance)
    return _Pair(facts, tuple(checks), facing, neighbours)


def _facing(first: Solid, second: Solid, spacing: Spacing, clearance: float) -> tuple[tuple[str, Facing], ...]:
    """Return how triangles of either part face the other, by its name."""
    one, other = spacing.first, spacing.second
    return (
        (first.part.name, Facing.between(one, other, spacing.to_second, clearance=clearance)),
        (second.part.name, Facing.between(other, one, spacing.to_first, clearance=clearance)),
    )


def _joints(pairs: Iterable[_Pair]) -> Mapping[str, Sequence[Facing]]:
    """Return the joints of each part with any other one."""
    joints: dict[str, list[Facing]] = {}
    for name, facing in (each for pair in pairs for each in pair.joints):
        joints.setdefault(name, []).append(facing)
    return MappingProxyType(joints)


def _unmeasured(prefix: str, first: Part, second: Part, *, spoiler: Part) -> _Pair:
    message = f"{first.name} and {second.name} were not measured, because {spoiler.name} is no solid"
    checks = (
        Check(f"{prefix}.{what}", ok=False, skipped=True, message=message)
        for what in ("overlap", "gap", "gap_max", "mobility")
    )
    return _Pair(UNKNOWN, tuple(checks))


def _holding(
    spacing: Spacing, first: Solid, second: Solid, gap: Gap, clearance: float | None, *, one: bool
) -> Holding | None:
    """Return how neighbouring parts hold each other, or None where the clearance is not known.

    `one` says that they share faces or volume. Contacts are looked for as far as the parts really are apart, if that
    is more than the clearance.
    """
    if one:
        return Holding("fused")
    if clearance is None:
        return None
    between = max(clearance, gap.min)
    return holding(spacing, first.manifold, second.manifold, clearance=between) if between > 0.0 else Holding(None)


def _moving(code: str, first: Part, second: Part, found: Holding | None, expectations: Expectations) -> Check:
    if found is not None:
        return holding_check(code, first, second, found, expected=expectations.expected_verdict)
    message = f"how {first.name} and {second.name} move was not judged, because the clearance is not known"
    return Check(code, ok=False, skipped=True, message=message)


def _verdict(count: int, pairs: Sequence[_Pair]) -> Verdict | None:
    """Return what all parts are: captive where neighbours are, and each part is joined to every other by neighbours.

    `pairs` are those of `count` parts in the order of `combinations`.
    """
    if not all(pair.measured for pair in pairs):
        return None
    verdicts = {pair.facts.verdict for pair in pairs} - {None}
    if "separable" in verdicts:
        return "separable"
    if _groups(count, [pair.facts.verdict is not None for pair in pairs]) > 1:
        return None
    return "captive" if "captive" in verdicts else "fused"


def _joined(parts: Sequence[Part], pairs: Sequence[_Pair], clearance: float | None) -> tuple[Check, ...]:
    """Check that more than two parts are all joined to each other by neighbours; of two, the gap says so."""
    if len(parts) == 2:
        return ()
    code, names = "fit.joined", ", ".join(part.name for part in parts)
    if clearance is None or not all(pair.measured for pair in pairs):
        message = f"whether {names} are joined was not judged, because not every gap or no clearance is known"
        return (Check(code, ok=False, skipped=True, message=message),)
    groups = _groups(len(parts), [pair.neighbours for pair in pairs])
    message = f"{names} must be joined, each a clearance of {clearance:.4g} mm from a neighbour, and they are in "
    return (Check(code, ok=groups == 1, message=message + counted(groups, "group")),)


def _groups(count: int, linked: Sequence[bool]) -> int:
    """Return into how many groups parts fall, of which pairs, in the order of `combinations`, are linked or not."""
    links = [ends for ends, link in zip(combinations(range(count), 2), linked, strict=True) if link]
    graph = coo_array((np.ones(len(links)), np.reshape(links, (-1, 2)).T.astype(np.int64)), shape=(count, count))
    return int(connected_components(graph, directed=False)[0])
