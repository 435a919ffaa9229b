"""Optimising: each objective gets better when it counts, by what it was before, and narrow necks are kept out."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.arrays import Floats
from fabricate.config import OptimiseConfig
from fabricate.design.optimising import Optimised, optimised
from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.certificate import certified
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.handles import with_handles
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.mesh.knot import trefoil
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.surface.limit import limit_vertices
from fabricate.surface.neck import NeckGauge, coarse_necks
from fabricate.surface.sizing import sized


def sphere() -> Duotone:
    return random_duotone(subdivided(sized(geodesic_sphere(frequency=3), size=60), levels=1), seed=7)


def knot() -> Duotone:
    quads = subdivided(sized(trefoil(around=36, across=5, tube=0.4), size=60), levels=1)
    return with_handles(random_duotone(quads, seed=7), yellow=1, seed=7)


SHAPES = {"sphere": sphere(), "knot": knot()}
BETTER = [
    ("neck", 1.0, 1.0),
    ("evenness", 1.0, -1.0),
    ("alignment", 1.0, 1.0),
    ("tips", 1.0, -1.0),
    ("tips", -1.0, 1.0),
    ("corridor", 1.0, 1.0),
    ("corridor", -1.0, -1.0),
]
"""Objectives, how much they count, and whether their values grow then."""


def along_circles(quads: QuadMesh) -> Floats:
    """Return |cos| between each tile's diagonals and the circles about the z axis."""
    corners = limit_vertices(quads)[quads.tiles]
    diagonals = corners[:, 2:] - corners[:, :2]
    diagonals /= np.linalg.norm(diagonals, axis=2, keepdims=True)
    x, y, _ = corners.mean(axis=1).T
    round_axis = np.stack([-y, x, np.zeros_like(x)], axis=1) / np.hypot(x, y)[:, None]
    costs: Floats = np.abs(np.einsum("tkj,tj->tk", diagonals, round_axis))
    return costs


def better(duotone: Duotone, *, least: float = 0.1, across: bool = False, **asked: float) -> Optimised:
    config = OptimiseConfig.model_validate({"flips": 2500, **asked})
    alignments = along_circles(duotone.quads)
    return optimised(duotone, config, rings=[0.5], neck=least, seed=3, alignments=alignments, across=across)


@pytest.mark.parametrize(("name", "weight", "sign"), BETTER)
@pytest.mark.parametrize("shape", SHAPES)
def test_each_objective_gets_better_alone(shape: str, name: str, weight: float, sign: float) -> None:
    duotone = SHAPES[shape]
    found = better(duotone, **{name: weight})
    change = found.objectives[name]
    assert sign * (change.after - change.before) > (0.01 if name == "neck" else 0.1) * change.before
    assert certified(found.duotone) == certified(duotone)


def test_what_was_before_is_measured_without_any_flip() -> None:
    none = better(SHAPES["sphere"], tips=1, flips=0)
    some = better(SHAPES["sphere"], tips=1)
    assert np.array_equal(none.duotone.joined, SHAPES["sphere"].joined)
    assert {name: change.after for name, change in none.objectives.items()} == {
        name: change.before for name, change in some.objectives.items()
    }
    again = better(some.duotone, tips=1, flips=0)
    assert {name: change.before for name, change in again.objectives.items()} == {
        name: change.after for name, change in some.objectives.items()
    }


def test_alignment_is_measured_only_along_directions() -> None:
    found = optimised(SHAPES["knot"], OptimiseConfig(tips=1, flips=10), rings=[0.5], neck=0.1, seed=3)
    assert sorted(found.objectives) == ["corridor", "evenness", "neck", "tips"]
    half = along_circles(SHAPES["knot"].quads)
    half[: len(half) // 2] = 0.0
    found = optimised(SHAPES["knot"], OptimiseConfig(tips=1, flips=1), rings=[0.5], neck=0.1, seed=3, alignments=half)
    joined = SHAPES["knot"].joined
    directed = np.where(joined, half[:, 0], half[:, 1])[len(half) // 2 :]
    assert found.objectives["alignment"].before == pytest.approx(directed.mean())


def test_narrow_necks_are_kept_out_whatever_counts() -> None:
    duotone = SHAPES["knot"]
    neck = float(np.quantile(coarse_necks(duotone, rings=[0.5]), 0.3))
    narrow = [
        np.count_nonzero(coarse_necks(better(duotone, tips=1, least=each).duotone, rings=[0.5]) < neck)
        for each in (0.01, neck)
    ]
    necks = NeckGauge.of(duotone.quads, rings=[0.5]).necks(duotone.quads.points)
    hopeless = np.count_nonzero(necks.max(axis=1) < neck)
    assert hopeless <= narrow[1] < hopeless + 0.5 * (narrow[0] - hopeless)


def test_time_that_is_up_ends_it_and_is_told() -> None:
    found = better(SHAPES["sphere"], tips=1, seconds=1e-6)
    assert found.notes == (
        "optimising ended after 0 of 2500 flips, when 1e-06 s were over: another run may give another curve",
    )
    assert np.array_equal(found.duotone.joined, SHAPES["sphere"].joined)
    assert better(SHAPES["sphere"], tips=1, flips=40, seconds=1000).notes == ()


def test_progress_is_told_ten_times() -> None:
    told: list[str] = []
    config = OptimiseConfig(tips=1, flips=200)
    optimised(SHAPES["sphere"], config, rings=[0.5], neck=0.1, seed=3, progress=told.append)
    assert told == [f"optimising: {tried} of 200 flips tried" for tried in range(0, 200, 20)]


def test_corridors_run_across_where_they_should() -> None:
    along, across = (better(SHAPES["sphere"], alignment=1, across=each).objectives["alignment"] for each in (0, 1))
    assert along.after > along.before + 0.2
    assert across.after < across.before - 0.2


def test_locked_tiles_stay() -> None:
    duotone = SHAPES["knot"]
    free = np.random.default_rng(3).random(len(duotone.joined)) < 0.5
    found = optimised(duotone, OptimiseConfig(tips=1, flips=500), rings=[0.5], neck=0.1, seed=3, free=free).duotone
    assert np.array_equal(found.joined[~free], duotone.joined[~free])
    assert not np.array_equal(found.joined, duotone.joined)


def test_the_same_arguments_give_the_same_duotone() -> None:
    first, again = (better(SHAPES["knot"], neck=1, evenness=1, corridor=0.5, tips=-0.2, flips=300) for _ in range(2))
    assert np.array_equal(first.duotone.joined, again.duotone.joined)
    assert first.objectives == again.objectives
