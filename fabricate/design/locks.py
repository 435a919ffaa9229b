"""Tiles that a wish locks, and which locks contradict each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.config.lock_config import LockConfig
from fabricate.design.contradiction import blue_cut, yellow_ring
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.spanning_tree import weighted_duotone
from fabricate.duotone.tile_locks import TileLocks
from fabricate.errors import PatternError
from fabricate.surface.tile_places import TilePlaces

NAMED = 6
"""Of more tiles a message names only as many."""


def tile_locks(quads: QuadMesh, locks: Sequence[LockConfig], *, seed: int) -> TileLocks:
    """Return the tiles that locks hold in either colour.

    Locks that hold all of their tiles come first. Of locks that hold most of theirs, a spanning tree drawn from `seed`
    decides: it joins as many of these tiles in their colour as one curve allows, and they are held, the others are
    free. Where two such locks of different colours meet, the earlier one has the tile.

    Raises
    ------
    PatternError
        If a lock holds no tile, or no tree keeps to the locks that hold all of theirs. The message names
        the locks by their keys and says where they contradict each other.
    """
    middles = TilePlaces.of(quads).middle
    held = [_held(lock, number, middles) for number, lock in enumerate(locks)]
    firm = _firm(quads, _Owners.of(locks, held, middles))
    loose = np.zeros(len(middles))
    for lock, tiles in reversed(list(zip(locks, held, strict=True))):
        if lock.hold == "most":
            loose[tiles] = -1.0 if lock.joined == "yellow" else 1.0
    if not loose.any():
        return firm
    joined = weighted_duotone(quads, loose, seed=seed, locks=firm).joined
    return TileLocks(firm.yellow | (joined & (loose < 0.0)), firm.blue | (~joined & (loose > 0.0) & firm.free))


def _held(lock: LockConfig, number: int, middles: Floats) -> Indices:
    """Return the tiles at the place of a lock."""
    if lock.tiles is not None:
        tiles = np.unique(lock.tiles)
        if tiles[-1] >= len(middles):
            last = len(middles) - 1
            raise PatternError(f"{_key(number)} holds tile {tiles[-1]}, but tiles are numbered from 0 to {last}")
        return tiles
    if lock.side is not None:
        beyond = (middles - np.asarray(lock.side.point)) @ np.asarray(lock.side.normal)
        return _some(np.flatnonzero(beyond > 0.0), number, "all are on the other side of its plane")
    away = np.linalg.norm(middles - np.asarray(lock.near), axis=1)
    return _some(np.flatnonzero(away <= (lock.within or 0.0)), number, f"the nearest is {away.min():.4g} mm away")


def _some(tiles: Indices, number: int, otherwise: str) -> Indices:
    if not len(tiles):
        raise PatternError(f"{_key(number)} holds no tile: {otherwise}")
    return tiles


@dataclass(frozen=True, eq=False)
class _Owners:
    """By which lock each tile is held in yellow and in blue, (t,) int; -1 where by none."""

    yellow: Indices
    blue: Indices
    middles: Floats

    @classmethod
    def of(cls, locks: Sequence[LockConfig], held: Sequence[Indices], middles: Floats) -> _Owners:
        """Return the first lock of each colour that holds each tile, of those that hold all of theirs."""
        owner = {colour: np.full(len(middles), -1) for colour in ("yellow", "blue")}
        for number in reversed(range(len(locks))):
            if locks[number].hold == "all":
                owner[locks[number].joined][held[number]] = number
        return cls(owner["yellow"], owner["blue"], middles)

    def contradict(self, owners: Indices, tiles: Indices, what: str) -> PatternError:
        """Return the error that names the owners of some tiles, and the tiles."""
        keys, place = [_key(number) for number in np.unique(owners)], self.middles[tiles[0]]
        who = f"{keys[0]} contradicts itself" if len(keys) == 1 else f"{_listed(keys)} contradict each other"
        named = ("tile " if len(tiles) == 1 else "tiles ") + _listed([str(tile) for tile in tiles])
        return PatternError(f"{who}: {named} at ({', '.join(f'{value:.4g}' for value in place)}) mm {what}")


def _firm(quads: QuadMesh, owners: _Owners) -> TileLocks:
    """Return the tiles of locks that hold all of theirs, if a tree keeps to them."""
    yellow, blue = owners.yellow >= 0, owners.blue >= 0
    both = np.flatnonzero(yellow & blue)
    if len(both):
        pair = np.concatenate([owners.yellow[both[:1]], owners.blue[both[:1]]])
        raise owners.contradict(pair, both[:1], "is to be joined in yellow and in blue")
    remedy = '; hold = "most" joins as many tiles as one curve allows'
    ring = yellow_ring(quads, yellow)
    if len(ring):
        raise owners.contradict(owners.yellow[ring], ring, f"would close a ring in yellow{remedy}")
    cut = blue_cut(quads, blue)
    if len(cut):
        raise owners.contradict(owners.blue[cut], cut, f"would close a ring in blue, which cuts yellow apart{remedy}")
    return TileLocks(yellow, blue)


def _key(number: int) -> str:
    return f"pattern.locks[{number}]"


def _listed(words: Sequence[str]) -> str:
    """Return words as "a, b and c", of which no more than `NAMED` are there."""
    if len(words) > NAMED:
        words = [*words[: NAMED - 1], f"{len(words) - NAMED + 1} more"]
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)
