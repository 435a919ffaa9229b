"""Locks hold the tiles at their places, or say which of them contradict each other."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import seeds
from round_tiles import round_tiles

from fabricate.config import LockConfig, SideConfig
from fabricate.design.contradiction import blue_cut, yellow_ring
from fabricate.design.locks import tile_locks
from fabricate.duotone.certificate import certified
from fabricate.duotone.spanning_tree import grown_duotone, random_duotone
from fabricate.errors import PatternError
from fabricate.surface.tile_places import TilePlaces

BALL = round_tiles()
MIDDLES = TilePlaces.of(BALL).middle
NORTH = SideConfig(point=(0.0, 0.0, 5.0), normal=(0.0, 0.0, 2.0))
BLUE_POINT = int(np.flatnonzero(~BALL.yellow)[0])
ROUND_BLUE = tuple(np.flatnonzero((BALL.tiles == BLUE_POINT).any(axis=1)).tolist())
ROUND_YELLOW = tuple(np.flatnonzero((BALL.tiles == int(np.flatnonzero(BALL.yellow)[0])).any(axis=1)).tolist())


def refusal(*locks: LockConfig) -> str:
    with pytest.raises(PatternError) as caught:
        tile_locks(BALL, locks, seed=0)
    message = str(caught.value)
    assert "\n" not in message
    return message


def test_tiles_near_a_point_are_held() -> None:
    point = tuple(1.1 * MIDDLES[7])
    found = tile_locks(BALL, [LockConfig(joined="blue", near=point, within=6.0)], seed=0)  # type: ignore[arg-type]
    assert (found.blue == (np.linalg.norm(MIDDLES - point, axis=1) <= 6.0)).all()
    assert found.blue[7]
    assert not found.yellow.any()


def test_tiles_are_held_by_their_numbers() -> None:
    found = tile_locks(
        BALL, [LockConfig(joined="yellow", tiles=(9, 3, 9)), LockConfig(joined="blue", tiles=(5,))], seed=0
    )
    assert np.flatnonzero(found.yellow).tolist() == [3, 9]
    assert np.flatnonzero(found.blue).tolist() == [5]


@pytest.mark.parametrize("joined", ["yellow", "blue"])
def test_as_many_as_one_curve_allows_are_held_on_a_side(joined: str) -> None:
    lock = LockConfig.model_validate({"joined": joined, "hold": "most", "side": NORTH})
    found = tile_locks(BALL, [lock], seed=3)
    held, there = (found.yellow, MIDDLES[:, 2] > 5.0) if joined == "yellow" else (found.blue, MIDDLES[:, 2] > 5.0)
    assert not (held & ~there).any()
    assert not (found.yellow if joined == "blue" else found.blue).any()
    for seed in range(5):
        grown = random_duotone(BALL, seed=seed)
        assert ((grown.joined if joined == "yellow" else ~grown.joined) & there).sum() <= held.sum()
        kept = random_duotone(BALL, seed=seed, locks=found)
        assert certified(kept).holds
        assert ((kept.joined if joined == "yellow" else ~kept.joined) & there).sum() == held.sum()


def test_firm_locks_come_before_loose_ones() -> None:
    tiles = tuple(np.flatnonzero(MIDDLES[:, 2] > 5.0)[::9].tolist())
    loose = LockConfig(joined="yellow", hold="most", side=NORTH)
    found = tile_locks(BALL, [loose, LockConfig(joined="blue", tiles=tiles)], seed=0)
    assert found.blue[list(tiles)].all()
    assert found.blue.sum() == len(tiles)
    assert found.yellow.sum() > 100


def test_of_loose_locks_the_earlier_one_comes_first() -> None:
    both = [LockConfig(joined=joined, hold="most", tiles=(3,)) for joined in ("yellow", "blue")]
    assert tile_locks(BALL, both, seed=0).yellow[3]
    assert tile_locks(BALL, both[::-1], seed=0).blue[3]


colours = st.sampled_from(["yellow", "blue"])
points = st.tuples(*3 * [st.floats(-50, 50)]).filter(lambda point: any(point))
PLACES = st.one_of(
    st.builds(lambda normal: {"side": {"point": (0.0, 0.0, 0.0), "normal": normal}}, points),
    st.builds(lambda tile: {"near": tuple(MIDDLES[tile]), "within": 9.0}, st.integers(0, 959)),
    st.builds(lambda tiles: {"tiles": tuple(tiles)}, st.lists(st.integers(0, 959), min_size=1)),
)
LOOSE = st.lists(
    st.builds(lambda joined, place: LockConfig(joined=joined, hold="most", **place), colours, PLACES), min_size=1
)


@given(locks=LOOSE, seed=seeds, tree=st.sampled_from(["random", "uniform", "breadth-first", "depth-first"]))
def test_loose_locks_never_contradict(locks: list[LockConfig], seed: int, tree: str) -> None:
    found = tile_locks(BALL, locks, seed=seed)
    grown = grown_duotone(BALL, tree=tree, seed=seed, locks=found)  # type: ignore[arg-type]
    assert certified(grown).holds
    assert grown.joined[found.yellow].all()
    assert not grown.joined[found.blue].any()


FIRM = st.lists(
    st.builds(lambda joined, tiles: LockConfig(joined=joined, tiles=tuple(tiles)), colours,
              st.lists(st.integers(0, 959), min_size=1, max_size=40)), min_size=1, max_size=8)  # fmt: skip


@given(locks=FIRM)
def test_firm_locks_hold_all_of_their_tiles_or_contradict(locks: list[LockConfig]) -> None:
    yellow, blue = np.zeros((2, len(BALL.tiles)), dtype=bool)
    for lock in locks:
        (yellow if lock.joined == "yellow" else blue)[list(lock.tiles or ())] = True
    if (yellow & blue).any() or len(yellow_ring(BALL, yellow)) or len(blue_cut(BALL, blue)):
        assert "contradict" in refusal(*locks)
    else:
        found = tile_locks(BALL, locks, seed=0)
        assert (found.yellow == yellow).all()
        assert (found.blue == blue).all()


def test_one_tile_in_two_colours_is_a_contradiction() -> None:
    yellow, other, blue = (
        LockConfig(joined=joined, tiles=tiles)
        for joined, tiles in [("yellow", (1, 2)), ("blue", (4,)), ("blue", (2, 3))]
    )
    message = refusal(yellow, other, blue)
    assert message.startswith("pattern.locks[0] and pattern.locks[2] contradict each other: tile 2 at (")
    assert "mm is to be joined in yellow and in blue" in message


def test_a_yellow_ring_is_a_contradiction() -> None:
    message = refusal(LockConfig(joined="yellow", tiles=ROUND_BLUE))
    assert message.startswith("pattern.locks[0] contradicts itself: tiles ")
    assert all(str(tile) in message for tile in ROUND_BLUE)
    assert "close a ring in yellow" in message
    assert 'hold = "most"' in message


def test_the_locks_of_a_ring_are_named_and_no_others() -> None:
    first, second = ROUND_BLUE[:2], ROUND_BLUE[2:]
    other = next(tile for tile in range(960) if tile not in ROUND_BLUE)
    locks = [LockConfig(joined="yellow", tiles=tiles) for tiles in (first, (other,), second)]
    assert refusal(*locks).startswith("pattern.locks[0] and pattern.locks[2] contradict each other: tiles ")


def test_a_blue_ring_is_a_contradiction() -> None:
    message = refusal(LockConfig(joined="blue", tiles=ROUND_YELLOW))
    assert "would close a ring in blue, which cuts yellow apart" in message
    x, y, z = MIDDLES[min(ROUND_YELLOW)]
    assert f"({x:.4g}, {y:.4g}, {z:.4g}) mm" in message


def test_long_rings_are_cut_short_in_words() -> None:
    message = refusal(LockConfig(joined="yellow", side=SideConfig(point=(0.0, 0.0, -60.0), normal=(0.0, 0.0, 1.0))))
    assert len(message) < 250


@pytest.mark.parametrize(
    ("lock", "words"),
    [
        (LockConfig(joined="blue", tiles=(3, 960)), "holds tile 960, but tiles are numbered from 0 to 959"),
        (LockConfig(joined="blue", near=(0.0, 0.0, 0.0), within=9.0), "holds no tile: the nearest is 4"),
        (
            LockConfig(joined="blue", side=SideConfig(point=(0.0, 0.0, 51.0), normal=(0.0, 0.0, 1.0))),
            "holds no tile: all are on the other side",
        ),
    ],
)
def test_locks_that_hold_nothing_are_wrong(lock: LockConfig, words: str) -> None:
    assert f"pattern.locks[1] {words}" in refusal(LockConfig(joined="blue", tiles=(3,)), lock)
