"""Flips of two interlaced tiles: the steps from one single curve to another.

The curve visits every tile twice. Two tiles are *interlaced* when their visits alternate, a b a b; flipping both, and
only then, keeps one curve. An arc has the number of the side through which it enters, so a flip of one tile leaves
the arcs' numbers as they are and exchanges what follows its two arcs. For visits a b a' b' and the stretches between,

    a P b Q a' R b' S   becomes   a R b' Q a' P b S:

three stretches (P b, Q a', R b') in the opposite order, each in its old direction. Yellow stays on the left.

Every single curve can be reached from every other one by such flips (Bouchet, Mathematical Programming 38, 1987;
Chun, Moffatt, Noble and Rueckriemen, J. Combin. Theory A 167, 2019). Of the two tiles

    one yellow-joined, one blue-joined: handles stay where they are, as in the exchange of an edge of a tree;
    both blue-joined:                   one handle moves from blue to yellow;
    both yellow-joined:                 one handle moves from yellow to blue.
"""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Indices, Mask
from fabricate.duotone.curve import traced_arcs
from fabricate.duotone.duotone import Duotone
from fabricate.errors import PatternError

TAG_SEED = 7
"""Draws the tags that tell sets of tiles apart; two sets look alike with a chance of 2^-63."""


def flipped(duotone: Duotone, first: int, second: int) -> Duotone:
    """Return the duotone with two interlaced tiles flipped; it has one curve as before.

    For many flips in a row use a `FlippingCurve`, which does not trace the curve again.

    Raises
    ------
    PatternError
        If they are not two tiles or not interlaced, or if the duotone has more than one curve.
    """
    curve = FlippingCurve(duotone)
    curve.flip(first, second)
    return curve.duotone


class FlippingCurve:
    """The one curve of a duotone while pairs of tiles are flipped, as the cyclic order of its arcs.

    A flip moves the arcs between four visits and nothing else. The arrays are views that change with every flip.

    Raises
    ------
    PatternError
        If the duotone has more than one curve.
    """

    def __init__(self, duotone: Duotone) -> None:
        self._quads = duotone.quads
        self._joined = duotone.joined.copy()
        self._order = traced_arcs(duotone)
        self._place = np.zeros_like(self._order)
        self._place[self._order] = np.arange(len(self._order))

    @property
    def joined(self) -> Mask:
        """(t,) bool: which tiles are yellow-joined now."""
        view = self._joined.view()
        view.flags.writeable = False
        return view

    @property
    def order(self) -> Indices:
        """(2 t,) int: all arcs along the curve, yellow on the left, from any of them; see `fabricate.duotone.curve`."""
        view = self._order.view()
        view.flags.writeable = False
        return view

    @property
    def duotone(self) -> Duotone:
        """The duotone as it is now."""
        return Duotone(self._quads, self._joined)

    def interlaced(self, first: int, second: int) -> bool:
        """Return whether the visits of two tiles alternate."""
        begin, end = sorted(self._visits(first))
        one, other = self._visits(second)
        return first != second and (begin < one < end) != (begin < other < end)

    def partners(self, tile: int) -> Indices:
        """Return all tiles that are interlaced with one, in the order of the curve from one of its visits to the other.

        Takes time in proportion to the shorter of the two ways along the curve.
        """
        begin, end = sorted(self._visits(tile))
        if end - begin <= len(self._order) // 2:
            arcs = self._order[begin + 1 : end]
            back = self._place[arcs ^ 1]
            inner: Indices = arcs[(back < begin) | (back > end)] // 2
            return inner
        arcs = np.concatenate([self._order[end + 1 :], self._order[:begin]])
        back = self._place[arcs ^ 1]
        outer: Indices = arcs[(back > begin) & (back < end)] // 2
        return outer

    def interlaced_among(self, tiles: Mask) -> Mask:
        """Return which tiles of a set, (t,) bool, are interlaced with any other tile of that set.

        Every tile has a random tag. Between the visits of a tile the exclusive or of all tags is zero when each tile
        of the set is visited there twice or not at all.
        """
        tags = np.random.default_rng(TAG_SEED).integers(1, 2**63, size=len(tiles)) * tiles
        upto = np.bitwise_xor.accumulate(tags[self._order // 2])
        begin, end = np.sort(self._place.reshape(-1, 2), axis=1).T
        odd: Mask = upto[end - 1] != upto[begin]
        return tiles & odd

    def flip(self, first: int, second: int) -> None:
        """Flip two interlaced tiles.

        Raises
        ------
        PatternError
            If they are not two tiles or not interlaced; then nothing is changed.
        """
        if first == second or not all(0 <= tile < len(self._joined) for tile in (first, second)):
            raise PatternError(f"expected two tiles from 0 to {len(self._joined) - 1}, found {first} and {second}")
        if not self.interlaced(first, second):
            raise PatternError(
                f"tiles {first} and {second} are not interlaced: flipping both would leave three curves; "
                "flip pairs whose visits alternate along the curve"
            )
        self._rearrange(sorted(self._visits(first) + self._visits(second)))
        self._joined[[first, second]] ^= True

    def _visits(self, tile: int) -> tuple[int, int]:
        return int(self._place[2 * tile]), int(self._place[2 * tile + 1])

    def _rearrange(self, cuts: list[int]) -> None:
        """Exchange the stretches that end at the second and the fourth of four visits in a row.

        The order is cyclic, so of the four stretches the longest is the one that stays.
        """
        count = len(self._order)
        _, last = max(((cuts[k] - cuts[k - 1]) % count, k) for k in range(4))
        w, x, y, z = (cuts[(last + k) % 4] for k in range(4))
        places = np.arange(w + 1, w + 1 + (z - w) % count) % count
        arcs = self._order[places]
        one, two = (x - w) % count, (y - w) % count
        moved = np.concatenate([arcs[two:], arcs[one:two], arcs[:one]])
        self._order[places] = moved
        self._place[moved] = places
