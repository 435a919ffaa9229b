"""All checks of a pair of a million triangles, beside the time that building its two Manifolds takes.

python tests/benchmarks/checks.py

Exits with 1 when the checks take more than four times as long. The times are of the processor, so that other programs
do not count.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

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


def timed(stage: Callable[[], Result]) -> tuple[Result, float]:
    begin = time.process_time()
    return stage(), time.process_time() - begin


def main() -> int:
    with tempfile.TemporaryDirectory() as folder:
        config = load_config(CONFIG, [f"solid.tolerance={TOLERANCE}"])
        pipeline.run(config, name="first", out=Path(folder), progress=lambda _: None)
        made = Path(folder) / "first"
        parts, reading = timed(lambda: [read_part(made / f"{name}.stl") for name in ("yellow", "blue")])
        _, building = timed(lambda: [as_manifold(part) for part in parts])
        report, checking = timed(lambda: check([made], clearance=None))
    triangles = sum(len(part.triangles) for part in parts)
    ratio = (checking - reading - building) / building
    print(f"{triangles} triangles: Manifolds {building:.2f} s, checks {checking - reading - building:.2f} s more")
    print(f"the checks take {ratio:.1f} times as long as the Manifolds, at most {MOST:g} are asked for")
    return int(triangles < TRIANGLES or ratio > MOST or not report.parts)


if __name__ == "__main__":
    sys.exit(main())
