"""Handles of the two regions: how many each of them has, and how one moves from one region to the other.

One curve bounds both regions, so each is a closed surface of some genus less one disc, of Euler characteristic
1 - 2 g. The curve itself has none, hence (1 - 2 g_yellow) + (1 - 2 g_blue) = 2 - 2 g: yellow and blue handles
together are always the genus g of the surface. No curve makes them fewer or more; it only divides them.

Every division can be had. Along its boundary a region is a disc with bands, the tiles that are joined in its colour,
whose ends lie in the order of the curve's visits: in the dual picture, one vertex with a loop for each band. Such a
map without interlaced loops is plane. So a region that has a handle has two tiles that are interlaced, and flipping
these takes two bands away, which is one handle less; the other region gains it.
"""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Indices, Mask
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.flipping import FlippingCurve
from fabricate.errors import PatternError


def checked_handles(yellow: int, genus: int) -> int:
    """Return how many handles yellow is to have if a surface of this genus has as many.

    Raises
    ------
    PatternError
        If it has not; the message names the genus.
    """
    if not 0 <= yellow <= genus:
        raise PatternError(
            f"pattern.handles.yellow: the surface has genus {genus}, so yellow can have "
            f"{f'0 to {genus} handles' if genus else 'no handle'}, found {yellow}"
        )
    return yellow


def yellow_handles(duotone: Duotone) -> int:
    """Return the handles of the yellow region of a duotone with one curve: discs less bands are 1 - 2 g."""
    return (1 - int(duotone.quads.yellow.sum()) + int(duotone.joined.sum())) // 2


def with_handles(
    duotone: Duotone, *, yellow: int, seed: int, reluctance: Indices | None = None, free: Mask | None = None
) -> Duotone:
    """Return a duotone whose yellow region has `yellow` handles and whose blue region has the rest of the genus.

    Each handle that moves flips two tiles; all others stay as they are.

    Parameters
    ----------
    duotone : Duotone
        With one curve, from which as few tiles as possible are flipped.
    yellow : int
        From 0 to the genus.
    seed : int
        Draws the tiles that are flipped.
    reluctance : (t,) int, optional
        Of tiles that could be flipped, those are that have the least of it when they become yellow-joined, or the
        most when they become blue-joined, as far as interlaced ones are to be had.
    free : (t,) bool, optional
        Tiles that may be flipped; all by default.

    Raises
    ------
    PatternError
        If the surface has fewer handles, if the tiles that may be flipped have no such pair left, or if the duotone
        has more than one curve.
    """
    missing = checked_handles(yellow, duotone.quads.genus) - yellow_handles(duotone)
    blue_joined, allowed = missing > 0, np.ones(len(duotone.joined), dtype=bool) if free is None else free
    wish = np.zeros(len(allowed)) if reluctance is None else reluctance if blue_joined else -reluctance
    rank = np.lexsort([np.random.default_rng(seed).permutation(len(allowed)), wish]).argsort()
    curve = FlippingCurve(duotone)
    for _ in range(abs(missing)):
        pair = _best_pair(curve, allowed & (curve.joined != blue_joined), rank)
        if pair is None:
            raise PatternError(
                f"pattern.handles.yellow: expected {yellow}, but locked tiles keep it at "
                f"{yellow_handles(curve.duotone)}: lock fewer tiles or ask for another number"
            )
        curve.flip(*pair)
    return curve.duotone


def _best_pair(curve: FlippingCurve, candidates: Mask, rank: Indices) -> tuple[int, int] | None:
    """Return two interlaced tiles of a set, the first of the lowest rank and then the second, if there are any."""
    firsts = np.flatnonzero(curve.interlaced_among(candidates))
    if len(firsts) == 0:
        return None
    first = int(firsts[rank[firsts].argmin()])
    seconds = curve.partners(first)
    seconds = seconds[candidates[seconds]]
    return first, int(seconds[rank[seconds].argmin()])
