"""Whether the finished surface has the area share that was asked for."""

from __future__ import annotations

from fabricate.checks.check import Check
from fabricate.design.area_share import WITHIN


def share_checks(asked: float | None, *, found: float) -> tuple[Check, ...]:
    """Check yellow's share of the finished surface, between 0 and 1; no check where none was asked for."""
    if asked is None:
        return ()
    ok = abs(found - asked) <= WITHIN
    message = f"yellow must have {asked:g} of the surface, within {WITHIN:g}, and has {found:.5f}"
    return (Check("pattern.area_share", ok=ok, message=message),)
