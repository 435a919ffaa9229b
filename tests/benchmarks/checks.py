"""All checks of a pair of a million triangles, beside the time that building its two Manifolds takes.

python tests/benchmarks/checks.py

Exits with 1 when the checks take more than four times as long. The times are by the clock, because the checks use more
than one processor: run it on a computer that does nothing else. What all processors spend is said beside them.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple, TypeVar

from fabricate import pipeline
from fabricate.checks.geometry import as_manifold
from fabricate.checks.judge import read_part
from fabricate.config import load_config
from fabricate.pipeline import check

CONFIG = Path(__file__).parents[2] / "configs" / "first.toml"
TOLERANCE = "0.0055 mm"
"""Chord error for which the two parts of the config have a million triangles."""

TRIANGLES, MOST = 1_000_000, 4.0

Result = TypeVar("Result")


class Cost(NamedTuple):
    """Seconds by the clock, and of all processors together, those of other processes included."""

    clock: float
    processors: float

    def less(self, *others: Cost) -> Cost:
        return Cost(*(own - sum(rest) for own, *rest in zip(self, *others, strict=True)))


def timed(stage: Callable[[], Result]) -> tuple[Result, Cost]:
    clock, spent = time.perf_counter(), sum(os.times()[:4])
    result = stage()
    return result, Cost(time.perf_counter() - clock, sum(os.times()[:4]) - spent)


def main() -> int:
    with tempfile.TemporaryDirectory() as folder:
        config = load_config(CONFIG, [f"solid.tolerance={TOLERANCE}"])
        pipeline.run(config, name="first", out=Path(folder), progress=lambda _: None)
        made = Path(folder) / "first"
        parts, reading = timed(lambda: [read_part(made / f"{name}.stl") for name in ("yellow", "blue")])
        _, building = timed(lambda: [as_manifold(part) for part in parts])
        report, checking = timed(lambda: check([made], clearance=None))
    triangles = sum(len(part.triangles) for part in parts)
    more = checking.less(reading, building)
    ratio = more.clock / building.clock
    print(f"{triangles} triangles: Manifolds {building.clock:.2f} s, checks {more.clock:.2f} s more by the clock,")
    print(f"{building.processors:.2f} s and {more.processors:.2f} s of all processors")
    print(f"the checks take {ratio:.1f} times as long as the Manifolds, at most {MOST:g} are asked for")
    return int(triangles < TRIANGLES or ratio > MOST or not report.parts)


if __name__ == "__main__":
    sys.exit(main())
