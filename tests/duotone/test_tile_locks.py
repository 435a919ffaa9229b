"""Locks are masks that exclude each other."""

import numpy as np
import pytest
from polyhedra import named

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.tile_locks import TileLocks


def test_what_is_not_locked_is_free() -> None:
    locks = TileLocks(np.array([True, False, False]), np.array([False, True, False]))
    assert locks.free.tolist() == [False, False, True]
    assert not locks.yellow.flags.writeable


def test_without_locks_every_tile_is_free() -> None:
    quads = subdivided(named()["tetrahedron"], levels=1)
    assert TileLocks.none(quads).free.tolist() == [True] * 12


def test_no_tile_is_locked_in_both_colours() -> None:
    with pytest.raises(ValueError, match="locked in both colours"):
        TileLocks(np.ones(2, dtype=bool), np.array([False, True]))


def test_both_masks_are_of_one_length() -> None:
    with pytest.raises(ValueError, match="expected an array of shape"):
        TileLocks(np.zeros(2, dtype=bool), np.zeros(3, dtype=bool))
