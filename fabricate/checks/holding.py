"""Holding: the verdict on two parts, captive, separable or fused, each with its proof.

*Fused* are parts that share faces, or overlap. *Separable* are parts of which one was moved out of the other in steps
without overlap.
*Captive* are parts of which a few contacts stop every motion. Where a part is free to first order, but none of the
ways out could be gone to the end, or is caught, but no contacts prove it, there is no verdict.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from manifold3d import Manifold

from fabricate.arrays import Floats
from fabricate.checks.check import Check
from fabricate.checks.contacts import Contacts, contacts
from fabricate.checks.facts import Play, Verdict, Witness, Xyz
from fabricate.checks.gap import Spacing
from fabricate.checks.mobility import mobility
from fabricate.checks.parting import comes_out
from fabricate.checks.witness import witness
from fabricate.solid.part import Part


class Holding(NamedTuple):
    """How the first part is held by the second.

    Attributes
    ----------
    verdict : {"captive", "separable", "fused"} or None
        None where nothing could be proved.
    play : Play or None
        How far it moves; fused parts have none.
    witness : Contacts or None
        Of captive parts: the contacts that stop every motion.
    """

    verdict: Verdict | None
    play: Play | None = None
    witness: Contacts | None = None

    @property
    def witness_facts(self) -> Witness | None:
        """The witness as it stands in the report."""
        if self.witness is None:
            return None
        return Witness(_rows(self.witness.points), _rows(self.witness.normals))


def holding(spacing: Spacing, first: Manifold, second: Manifold, *, clearance: float) -> Holding:
    """Find out how two parts that are `clearance` mm apart, more than 0, hold each other."""
    met = contacts(spacing, clearance=clearance)
    found = mobility(met, spacing.first.points)
    if found.caught:
        proof = witness(met, found.pivot, found.radius)
        return Holding(None if proof is None else "captive", found.play, proof)
    out = any(comes_out(first, second, way, clearance=clearance, radius=found.radius) for way in found.ways_out)
    return Holding("separable" if out else None, found.play)


def holding_check(code: str, first: Part, second: Part, found: Holding, *, expected: Verdict) -> Check:
    """Check that two parts are caught in each other, come apart or are one, as expected; points at the witness."""
    names = f"{first.name} and {second.name}"
    if found.verdict is None:
        return Check(code, ok=False, message=f"{names} must be {expected}, which was not proved: {_doubt(found)}")
    return Check(
        code,
        ok=found.verdict == expected,
        message=f"{names} must be {expected}, and they {_meaning(found)}",
        where=np.zeros((0, 3)) if found.witness is None else found.witness.points,
    )


def _doubt(found: Holding) -> str:
    if found.play is None:
        return "they touch, and share no faces"
    if np.isinf([found.play.x, found.play.y, found.play.z]).any():
        return "no contact stops some motion, but moved that way one overlaps the other before it is out"
    return "they don't move far, but no few contacts stop every motion"


def _meaning(found: Holding) -> str:
    if found.verdict == "fused" or found.play is None:
        return "are fused: they share faces or overlap, and are one"
    if found.verdict == "separable" or found.witness is None:
        return "are separable: one was moved out of the other without overlap"
    way = max(found.play.x, found.play.y, found.play.z)
    return (
        f"are captive: they move by up to {way:.3g} mm along the axes, "
        f"and {len(found.witness.gaps)} contacts stop every motion"
    )


def _rows(vectors: Floats) -> tuple[Xyz, ...]:
    return tuple((float(x), float(y), float(z)) for x, y, z in vectors)
