"""What a curve is optimised for: how much each objective counts."""

from __future__ import annotations

from dataclasses import astuple, dataclass


@dataclass(frozen=True, kw_only=True)
class Weights:
    """How much each objective counts; 0 leaves it out, and 1 makes them about equally strong.

    Attributes
    ----------
    neck : float
        Wide necks, the narrowest above all.
    evenness : float
        The same yellow share everywhere.
    alignment : float
        Corridors along the directions of a field; across them if negative.
    tips : float
        Few ends of corridors; many if negative.
    corridor : float
        A long way between the two farthest ends of yellow; a short one if negative.
    """

    neck: float = 0.0
    evenness: float = 0.0
    alignment: float = 0.0
    tips: float = 0.0
    corridor: float = 0.0

    @property
    def total(self) -> float:
        """How much all objectives count together; 0 if none does."""
        return float(sum(abs(weight) for weight in astuple(self)))
