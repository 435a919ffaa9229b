"""Curve design of a million tiles by stages, every kind of tree, and flips; exits with 1 when one is slow.

python tests/benchmarks/curve.py
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from fabricate.config import CurvatureConfig, DirectionConfig, DistanceConfig, FieldConfig, HeightConfig
from fabricate.design.annealing import annealed
from fabricate.design.evenness import EvennessCost
from fabricate.design.field import FieldWish, field_weights
from fabricate.design.local_cost import LocalCost, TileCost
from fabricate.design.tips import TipCost
from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.certificate import certified
from fabricate.duotone.curve import traced_arcs
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
from fabricate.duotone.spanning_tree import grown_duotone, random_duotone, weighted_duotone
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import geodesic_sphere

FREQUENCY, LEVELS = 33, 3
"""20 f^2 triangles become 60 f^2 quads, and four times as many with each further level: 1 045 440."""

TILES, LIMIT, ROUNDS = 1_000_000, 3.0, 3
"""Fewest tiles, most seconds for all stages together, and how many rounds the best is chosen from."""

UNIFORM_FREQUENCY, UNIFORM_LEVELS, UNIFORM_LIMIT = 21, 2, 10.0
"""105 840 tiles for the tree that is drawn uniformly, and most seconds for it."""

FIELDS: dict[str, FieldConfig] = {
    "height": HeightConfig(kind="height"),
    "distance": DistanceConfig(kind="distance"),
    "curvature": CurvatureConfig(kind="curvature"),
    "circles": DirectionConfig(kind="direction", lines="circles"),
}

FLIPPED_FREQUENCY, FLIPS, FLIPS_LIMIT, TRIES = 6, 10_000, 10.0, 30_000
"""A sphere of 60 f^2 = 2160 tiles to optimise, flips that count, most seconds for so many, and flips that are tried."""

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


def along(quads: QuadMesh, field: FieldConfig) -> Duotone:
    """Join the tree that follows a field."""
    return weighted_duotone(quads, field_weights(quads, FieldWish(field), seed=7), seed=7)


def strategies() -> bool:
    """Time every kind of tree, print how long it took, and return whether all were quick enough.

    One that was not is tried again, as often as there are rounds.
    """
    quads = subdivided(geodesic_sphere(frequency=FREQUENCY), levels=LEVELS)
    fewer = subdivided(geodesic_sphere(frequency=UNIFORM_FREQUENCY), levels=UNIFORM_LEVELS)
    print(f"trees on {len(quads.tiles):,} tiles, the uniform one on {len(fewer.tiles):,}")
    return all(
        [
            quick("uniform", lambda: grown_duotone(fewer, tree="uniform", seed=7), UNIFORM_LIMIT),
            quick("breadth-first", lambda: grown_duotone(quads, tree="breadth-first", seed=7), LIMIT),
            quick("depth-first", lambda: grown_duotone(quads, tree="depth-first", seed=7), LIMIT),
            *(quick(name, lambda field=field: along(quads, field), LIMIT) for name, field in FIELDS.items()),
        ]
    )


def quick(name: str, grow: Callable[[], Duotone], limit: float) -> bool:
    seconds = limit + 1.0
    for _ in range(ROUNDS):
        if seconds > limit:
            begin = time.perf_counter()
            grow()
            seconds = min(seconds, time.perf_counter() - begin)
    print(f"  {name:<14}{seconds:6.2f} s   limit {limit:.2f} s: {'holds' if seconds <= limit else 'missed'}")
    return seconds <= limit


def flips() -> bool:
    """Time flips while all costs count that they change locally, and return whether they were quick enough."""
    quads = subdivided(geodesic_sphere(frequency=FLIPPED_FREQUENCY), levels=1)
    duotone, every = random_duotone(quads, seed=7), np.ones(len(quads.tiles), dtype=bool)
    costs: list[LocalCost] = [
        TileCost(np.random.default_rng(7).random((len(quads.tiles), 2)), duotone.joined),
        TipCost(duotone, weight=1.0),
        EvennessCost(duotone, arc=0.5, weight=1.0),
    ]
    begin = time.perf_counter()
    found = annealed(duotone, costs, flips=TRIES, seed=7, free=every)
    taken = time.perf_counter() - begin
    seconds = taken * FLIPS / found.made
    if not certified(found.duotone).holds:
        sys.exit("flips have left more than one curve")
    print(f"{found.made:,} of {TRIES:,} flips made on {len(quads.tiles):,} tiles in {taken:.2f} s")
    verdict = "holds" if seconds <= FLIPS_LIMIT else "missed"
    print(f"  {f'{FLIPS:,} flips':<14}{seconds:6.2f} s   limit {FLIPS_LIMIT:.2f} s: {verdict}")
    return seconds <= FLIPS_LIMIT


def main() -> int:
    sphere = geodesic_sphere(frequency=FREQUENCY)
    best = min((designed(sphere) for _ in range(ROUNDS)), key=lambda stages: stages.total)
    print(f"curve design of a sphere of {60 * FREQUENCY**2 * 4 ** (LEVELS - 1):,} tiles, best of {ROUNDS}")
    for name, seconds in best.seconds.items():
        print(f"  {name:<14}{seconds:6.2f} s")
    verdict = "holds" if best.total <= LIMIT else "missed"
    print(f"  {'total':<14}{best.total:6.2f} s   limit {LIMIT:.2f} s: {verdict}")
    return 0 if all([strategies(), flips(), best.total <= LIMIT]) else 1


if __name__ == "__main__":
    sys.exit(main())
