"""One check: a code, whether it passed, a sentence, and where."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from fabricate.arrays import Floats, frozen

MOST_PLACES = 20
"""Places named by one check; a hole with a thousand edges is found from a few of them."""


@dataclass(frozen=True, eq=False)
class Check:
    """The outcome of one check.

    Attributes
    ----------
    code : str
        Stable name, such as "yellow.closed" or "fit.gap".
    ok : bool
        True only when the check ran and passed.
    message : str
        One sentence: what was expected and what was found.
    skipped : bool
        True when it could not run; then `ok` is False, but the report is not failed by it.
    where : (k, 3) float
        Coordinates of the worst places, mm, at most 20; empty when there is nothing to point at.
    """

    code: str
    ok: bool
    message: str
    skipped: bool = False
    where: Floats = field(default_factory=lambda: np.zeros((0, 3)))

    def __post_init__(self) -> None:
        object.__setattr__(self, "where", frozen(self.where[:MOST_PLACES], np.float64, (None, 3)))

    @property
    def failed(self) -> bool:
        """True when it ran and did not pass."""
        return not self.ok and not self.skipped
