"""What each printing process can make: gaps that stay open, walls and features that come out, in mm."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal, TypeAlias

ProcessName: TypeAlias = Literal["fdm", "sla", "sls", "mjf"]


@dataclass(frozen=True, kw_only=True)
class Process:
    """Limits and defaults of one printing process; every length in mm.

    Attributes
    ----------
    name : {"fdm", "sla", "sls", "mjf"}
        Filament, resin, and the two powder processes.
    captive_gap : float
        Gap at which two parts printed in place come out loose.
    tight_gap : float or None
        Smaller gap that a well-tuned printer still keeps open.
    wall_min, wall_default : float
        Thinnest wall that comes out, and the wall to use when nothing else is asked for.
    feature_min : float
        Smallest detail or neck that comes out.
    crack_closed : float or None
        Gaps below this are closed by slicers.
    line_width : float or None
        Walls that are a multiple of it are filled without leftovers.
    hole_min : float or None
        Smallest diameter of a hole through which resin or powder leaves a hollow.
    holes_min : int
        How many such holes a hollow needs.
    """

    name: ProcessName
    captive_gap: float
    wall_min: float
    wall_default: float
    feature_min: float
    tight_gap: float | None = None
    crack_closed: float | None = None
    line_width: float | None = None
    hole_min: float | None = None
    holes_min: int = 0

    @property
    def gap_default(self) -> float:
        """Gap to use when nothing else is asked for, mm: the tight one where the process has one."""
        return self.captive_gap if self.tight_gap is None else self.tight_gap


_FDM = Process(
    name="fdm",
    captive_gap=0.4,
    tight_gap=0.3,
    wall_min=0.8,
    wall_default=2.4,
    feature_min=0.8,
    crack_closed=0.098,
    line_width=0.4,
)
_SLA = Process(name="sla", captive_gap=0.25, wall_min=0.5, wall_default=1.5, feature_min=0.5, hole_min=3.5, holes_min=1)
_SLS = Process(name="sls", captive_gap=0.5, wall_min=0.7, wall_default=2.0, feature_min=0.5, hole_min=3.5, holes_min=1)
_MJF = Process(name="mjf", captive_gap=0.5, wall_min=1.0, wall_default=2.0, feature_min=0.5, hole_min=2.0, holes_min=2)

PROCESSES: Mapping[str, Process] = MappingProxyType({p.name: p for p in (_FDM, _SLA, _SLS, _MJF)})
