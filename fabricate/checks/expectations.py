"""What a set of parts is expected to be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import NamedTuple

from fabricate.arrays import Floats
from fabricate.checks.facts import Spaces, Verdict, Xyz
from fabricate.config import ShopConfig
from fabricate.process import Process


class Neck(NamedTuple):
    """The narrowest neck of the pattern before clearance is taken off, mm, and where it is."""

    width: float
    at: Xyz


class Band(NamedTuple):
    """The narrowest place of the narrowest band.

    name; width there before clearance is taken off, mm; where it is; and spacing, how far apart the rings are that it
    lies between, as a share of tile sides.
    """

    name: str
    width: float
    at: Xyz
    spacing: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Expectations:
    """What the parts should be; the checks that need something left at None are skipped.

    Attributes
    ----------
    clearance : float or None
        Gap between the parts, mm.
    genus : mapping of str to int
        Handles of each part, by name; a part that is not in it has no genus expected.
    process : Process or None
        How they will be printed.
    shop : ShopConfig or None
        What the print shop accepts.
    neck : Neck or None
        The pattern's narrowest.
    band : Band or None
        The narrowest of a multitone; a duotone has none.
    spaces : Spaces or None
        What the parts leave free, and what they add up to with it.
    middles : mapping of str to (k, 3) float
        Places on the mid-line of the joint between two parts, by their names, such as "yellow-blue"; mm.
    tolerance : float or None
        Chord error of the surface, mm.
    verdict : {"captive", "separable", "fused"} or None
        Whether neighbouring parts come apart. Left at None it is "captive", or "fused" where the clearance is 0.
    """

    clearance: float | None = None
    genus: Mapping[str, int] = field(default_factory=dict)
    process: Process | None = None
    shop: ShopConfig | None = None
    neck: Neck | None = None
    band: Band | None = None
    spaces: Spaces | None = None
    middles: Mapping[str, Floats] = field(default_factory=dict)
    tolerance: float | None = None
    verdict: Verdict | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "genus", MappingProxyType(dict(self.genus)))
        object.__setattr__(self, "middles", MappingProxyType(dict(self.middles)))

    @property
    def expected_verdict(self) -> Verdict:
        """What neighbouring parts should be, with what `verdict` leaves open filled in."""
        return self.verdict or ("fused" if self.clearance == 0.0 else "captive")
