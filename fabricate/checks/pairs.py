"""Judging how parts go together: each pair of them, and all of them as a whole."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from types import MappingProxyType

import numpy as np
from manifold3d import Manifold
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fabricate.checks.check import Check
from fabricate.checks.contacts import REACH
from fabricate.checks.expectations import Expectations
from fabricate.checks.facts import FitFacts, Gap, PairFacts, Verdict
from fabricate.checks.fit import gap_check, overlap_check, whole_check
from fabricate.checks.gap import Spacing, smallest_gap
from fabricate.checks.holding import Holding, holding, holding_check
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

    @classmethod
    def of(cls, part: Part, manifold: Manifold) -> Solid:
        """Build the search tree of a part that Manifold has taken."""
        return cls(part, manifold, SearchTree.of(part.points, part.triangles))


@dataclass(frozen=True, eq=False)
class Fit:
    """How parts go together, and the checks of it."""

    facts: FitFacts
    checks: tuple[Check, ...]


@dataclass(frozen=True, eq=False)
class _Pair:
    """How two parts go together; without a gap where one of them is no solid."""

    facts: PairFacts
    checks: tuple[Check, ...]

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
    )
    return Fit(facts, (*checks, _whole(parts, expectations)))


def _pair(prefix: str, first: Solid, second: Solid, expectations: Expectations, *, only_pair: bool) -> _Pair:
    clearance = expectations.clearance
    common = first.manifold ^ second.manifold
    spacing = Spacing.between(first.tree, second.tree)
    gap = smallest_gap(spacing, first.manifold, second.manifold, clearance=clearance)
    smaller = min(first.manifold.volume(), second.manifold.volume())
    apart = not only_pair and clearance is not None and gap.min > REACH * clearance
    found = None if apart else _holding(spacing, first, second, gap, clearance)
    checks = (
        overlap_check(f"{prefix}.overlap", first.part, second.part, common, smaller_volume=smaller),
        gap_check(f"{prefix}.gap", first.part, second.part, gap, clearance=clearance),
        _moving(f"{prefix}.mobility", first.part, second.part, found, expectations, apart=apart),
    )
    facts = PairFacts(
        gap_mm=gap,
        overlap_mm3=common.volume(),
        verdict=found.verdict if found else None,
        play_mm=found.play if found else None,
        witness=found.witness_facts if found else None,
    )
    return _Pair(facts, checks)


def _unmeasured(prefix: str, first: Part, second: Part, *, spoiler: Part) -> _Pair:
    message = f"{first.name} and {second.name} were not measured, because {spoiler.name} is no solid"
    checks = (
        Check(f"{prefix}.{what}", ok=False, skipped=True, message=message) for what in ("overlap", "gap", "mobility")
    )
    return _Pair(UNKNOWN, tuple(checks))


def _holding(spacing: Spacing, first: Solid, second: Solid, gap: Gap, clearance: float | None) -> Holding | None:
    """Return how neighbouring parts hold each other, or None where the clearance is not known."""
    if clearance == 0.0 or gap.min == 0.0:
        return Holding("fused")
    return None if clearance is None else holding(spacing, first.manifold, second.manifold, clearance=clearance)


def _moving(
    code: str, first: Part, second: Part, found: Holding | None, expectations: Expectations, *, apart: bool
) -> Check:
    if found is not None:
        return holding_check(code, first, second, found, expected=expectations.expected_verdict)
    reason = "other parts lie between them" if apart else "the clearance is not known"
    message = f"how {first.name} and {second.name} move was not judged, because {reason}"
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
    held = [ends for ends, pair in zip(combinations(range(count), 2), pairs, strict=True) if pair.facts.verdict]
    graph = coo_array((np.ones(len(held)), np.reshape(held, (-1, 2)).T.astype(np.int64)), shape=(count, count))
    if connected_components(graph, directed=False)[0] > 1:
        return None
    return "captive" if "captive" in verdicts else "fused"


def _whole(parts: Sequence[Part], expectations: Expectations) -> Check:
    code = "fit.whole"
    if expectations.spaces is None:
        message = "volumes were not added up, because the uncut shell is not known"
        return Check(code, ok=False, skipped=True, message=message)
    return whole_check(code, parts, expectations.spaces.gap, expectations.spaces.shell)
