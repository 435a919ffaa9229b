"""Judging how parts go together: each pair of them, and all of them as a whole."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from manifold3d import Manifold

from fabricate.checks.check import Check
from fabricate.checks.expectations import Expectations
from fabricate.checks.facts import FitFacts, Gap
from fabricate.checks.fit import gap_check, overlap_check, whole_check
from fabricate.checks.gap import Spacing, smallest_gap
from fabricate.checks.mobility import Mobility, mobility, mobility_check
from fabricate.solid.part import Part
from fabricate.triangles.search_tree import SearchTree


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
    """How two parts that both are solids go together; `overlap` is in mm3."""

    spacing: Spacing
    gap: Gap
    overlap: float
    checks: tuple[Check, ...]


def fit(parts: Sequence[Part], solids: Mapping[str, Solid], expectations: Expectations) -> Fit:
    """Find out and check how two or more parts go together; `solids` holds those that are solids, by name."""
    clearance = expectations.clearance
    pairs: list[_Pair] = []
    checks: list[Check] = []
    for first, second in combinations(parts, 2):
        prefix = "fit" if len(parts) == 2 else f"fit.{first.name}-{second.name}"
        if first.name in solids and second.name in solids:
            pairs.append(_pair(prefix, solids[first.name], solids[second.name], clearance=clearance))
            checks += pairs[-1].checks
        else:
            checks += _unmeasured(prefix, first, second, spoiler=second if first.name in solids else first)
    found = _found_mobility(pairs, clearance) if len(parts) == 2 else None
    checks += [_whole(parts, expectations), _moving(parts, found, expectations)]
    facts = FitFacts(
        clearance_mm=clearance,
        gap_mm=min((pair.gap for pair in pairs), key=lambda gap: gap.min, default=None),
        overlap_mm3=sum(pair.overlap for pair in pairs) if pairs else None,
        verdict=found.verdict if found else None,
        play_mm=found.play if found else None,
    )
    return Fit(facts, tuple(checks))


def _pair(prefix: str, first: Solid, second: Solid, *, clearance: float | None) -> _Pair:
    common = first.manifold ^ second.manifold
    spacing = Spacing.between(first.tree, second.tree)
    gap = smallest_gap(spacing, first.manifold, second.manifold, clearance=clearance)
    smaller = min(first.manifold.volume(), second.manifold.volume())
    checks = (
        overlap_check(f"{prefix}.overlap", first.part, second.part, common, smaller_volume=smaller),
        gap_check(f"{prefix}.gap", first.part, second.part, gap, clearance=clearance),
    )
    return _Pair(spacing, gap, common.volume(), checks)


def _unmeasured(prefix: str, first: Part, second: Part, *, spoiler: Part) -> list[Check]:
    message = f"{first.name} and {second.name} were not measured, because {spoiler.name} is no solid"
    return [Check(f"{prefix}.{what}", ok=False, skipped=True, message=message) for what in ("overlap", "gap")]


def _found_mobility(pairs: Sequence[_Pair], clearance: float | None) -> Mobility | None:
    """Return the mobility of the only pair, or None where it can't be told."""
    if not pairs:
        return None
    if clearance == 0.0 or pairs[0].gap.min == 0.0:
        return Mobility("fused", None)
    return None if clearance is None else mobility(pairs[0].spacing, clearance=clearance)


def _moving(parts: Sequence[Part], found: Mobility | None, expectations: Expectations) -> Check:
    code = "fit.mobility"
    if found is not None:
        return mobility_check(code, parts[0], parts[1], found, expected=expectations.expected_verdict)
    if len(parts) > 2:
        reason = "it is judged for two parts only"
    elif expectations.clearance is None:
        reason = "the clearance is not known"
    else:
        reason = "not both are solids"
    return Check(code, ok=False, skipped=True, message=f"how the parts move was not judged, because {reason}")


def _whole(parts: Sequence[Part], expectations: Expectations) -> Check:
    code = "fit.whole"
    if expectations.spaces is None:
        message = "volumes were not added up, because the uncut shell is not known"
        return Check(code, ok=False, skipped=True, message=message)
    return whole_check(code, parts, expectations.spaces.gap, expectations.spaces.shell)
