"""Evenness: shares of area within sliding neighbourhoods."""

from __future__ import annotations

import numpy as np
import pytest
from costs import assert_foretells
from hypothesis import given, settings
from polyhedra import seeds
from truchet import any_states

from fabricate.design.evenness import EvennessCost, chance_unevenness, unevenness
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import two_coloured
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.mesh.torus import torus
from fabricate.surface.limit import limit_vertices

TORUS = two_coloured(torus(around=24, across=12, tube=0.4))


def naive_unevenness(duotone: Duotone, areas: np.ndarray, arc: float) -> float:
    """Walk from each tile in all ways of three steps, tile by tile, and weigh the shares of flat tiles."""
    beside = [[tile, *(duotone.quads.twins[4 * tile : 4 * tile + 4] // 4).tolist()] for tile in range(len(areas))]
    shares = np.where(duotone.joined, 1 - np.pi / 2 * (1 - arc) ** 2, np.pi / 2 * arc**2)
    target = 0.5 + np.pi / 4 * (2 * arc - 1)
    found = []
    for tile in range(len(areas)):
        ends = [d for b in beside[tile] for c in beside[b] for d in beside[c]]
        found.append(np.average(shares[ends], weights=areas[ends]) - target)
    return float(np.sqrt(np.mean(np.square(found))))


def halved_area(tile: np.ndarray) -> float:
    """Return the area of a quad as that of two triangles."""
    first, second = np.cross(tile[1] - tile[0], tile[2] - tile[0]), np.cross(tile[2] - tile[0], tile[3] - tile[0])
    return float(np.linalg.norm(first) + np.linalg.norm(second)) / 2


@pytest.mark.parametrize("arc", [0.35, 0.5, 0.6])
def test_it_is_what_walking_from_tile_to_tile_finds(arc: float) -> None:
    duotone = random_duotone(TORUS, seed=3)
    areas = np.array([halved_area(tile) for tile in limit_vertices(TORUS)[TORUS.tiles]])
    assert unevenness(duotone, arc=arc) == pytest.approx(naive_unevenness(duotone, areas, arc), rel=0.01)


def test_stripes_are_less_even_than_a_chequerboard() -> None:
    row = np.arange(len(TORUS.tiles)) // 12
    column = np.arange(len(TORUS.tiles)) % 12
    chequered, striped = ((row + column) % 2 == 0), (row // 6) % 2 == 0
    found = [unevenness(Duotone(TORUS, joined), arc=0.5) for joined in (chequered, striped)]
    assert found[0] < 0.3 * found[1]


def test_chance_is_what_coins_give() -> None:
    rng = np.random.default_rng(5)
    tossed = [unevenness(Duotone(TORUS, rng.random(len(TORUS.tiles)) < 0.5), arc=0.6) for _ in range(200)]
    assert np.sqrt(np.mean(np.square(tossed))) == pytest.approx(chance_unevenness(TORUS, arc=0.6), rel=0.05)


@settings(max_examples=30)
@given(duotone=any_states(), seed=seeds)
def test_changes_are_foretold(duotone: Duotone, seed: int) -> None:
    scale = 0.7 * len(duotone.joined) / chance_unevenness(duotone.quads, arc=0.45) ** 2

    def total(other: Duotone) -> float:
        return scale * unevenness(other, arc=0.45) ** 2

    assert_foretells(EvennessCost(duotone, arc=0.45, weight=0.7), duotone, total, seed=seed)
