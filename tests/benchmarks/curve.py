"""Curve design of a sphere of a million tiles, stage by stage; exits with 1 when it takes too long.

python tests/benchmarks/curve.py
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.certificate import certified
from fabricate.duotone.curve import traced_arcs
from fabricate.duotone.quad_mesh import two_coloured
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import geodesic_sphere

FREQUENCY, LEVELS = 33, 3
"""20 f^2 triangles become 60 f^2 quads, and four times as many with each further level: 1 045 440."""

TILES, LIMIT, ROUNDS = 1_000_000, 3.0, 3
"""Fewest tiles, most seconds for all stages together, and how many rounds the best is chosen from."""

Result = TypeVar("Result")


class Stages:
    """Seconds of one round, by stage."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}

    def timed(self, name: str, stage: Callable[[], Result]) -> Result:
        begin = time.perf_counter()
        result = stage()
        self.seconds[name] = time.perf_counter() - begin
        return result

    @property
    def total(self) -> float:
        return sum(self.seconds.values())


def designed(sphere: PolygonMesh) -> Stages:
    """Design the curve once; its colours are found anew from bare quads, as on a mesh used as it is."""
    stages = Stages()
    refined = stages.timed("Catmull-Clark", lambda: subdivided(sphere, levels=LEVELS))
    bare = PolygonMesh(refined.points, refined.tiles.ravel(), np.arange(0, refined.tiles.size + 1, 4))
    quads = stages.timed("colours", lambda: two_coloured(bare))
    duotone = stages.timed("tree", lambda: random_duotone(quads, seed=7))
    order = stages.timed("trace", lambda: traced_arcs(duotone))
    certificate = stages.timed("certificate", lambda: certified(duotone))
    if len(quads.tiles) < TILES or len(order) != 2 * len(quads.tiles) or not certificate.holds:
        sys.exit(f"not the curve that was to be timed: {len(quads.tiles)} tiles, {certificate}")
    return stages


def main() -> int:
    sphere = geodesic_sphere(frequency=FREQUENCY)
    best = min((designed(sphere) for _ in range(ROUNDS)), key=lambda stages: stages.total)
    print(f"curve design of a sphere of {60 * FREQUENCY**2 * 4 ** (LEVELS - 1):,} tiles, best of {ROUNDS}")
    for name, seconds in best.seconds.items():
        print(f"  {name:<14}{seconds:6.2f} s")
    verdict = "holds" if best.total <= LIMIT else "missed"
    print(f"  {'total':<14}{best.total:6.2f} s   limit {LIMIT:.2f} s: {verdict}")
    return 0 if best.total <= LIMIT else 1


if __name__ == "__main__":
    sys.exit(main())
