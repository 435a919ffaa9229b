"""Spanning trees drawn at random, each as likely as any other."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from fabricate.arrays import Indices

DRAWS = 1 << 18
"""Most random numbers that are drawn at once."""


def uniform_tree(ends: Indices, *, nodes: int, seed: int) -> Indices:
    """Return the edges of a spanning tree, (nodes - 1,) int, drawn with the same chance from all there are.

    Source: Wilson, Generating random spanning trees more quickly than the cover time, STOC 1996. A walk from a node
    outside of the tree goes on at random until it meets the tree; what is left of it, once its loops are dropped,
    becomes a branch. The walk knows where it goes next only when it is there: as a plain loop it takes a tenth of the
    time of arrays in which all loops of all nodes are dropped at once, round after round.

    Parameters
    ----------
    ends : (m, 2) int
        Nodes that each edge joins, all of them in one piece. Parallel edges are edges of their own.
    nodes : int
        How many nodes there are, numbered from 0.
    seed : int
        Another seed gives another tree.
    """
    tails = ends.T.ravel()
    by_tail = np.argsort(tails, kind="stable")
    first = np.searchsorted(tails[by_tail], np.arange(nodes + 1))
    heads = np.roll(ends, 1, axis=1).T.ravel()[by_tail]
    draws = _draws(seed, at_once=min(4 * nodes, DRAWS))
    leaving = _branches(heads.tolist(), first[:-1].tolist(), np.diff(first).tolist(), draws)
    chosen: Indices = by_tail[leaving[1:]] % len(ends)
    return chosen


def _branches(heads: list[int], first: list[int], valence: list[int], draws: Iterator[float]) -> Indices:
    """Return the arrow on which each node leaves towards node 0; those of node v are numbered from `first[v]` on."""
    leaving, in_tree = [0] * len(first), [True] + [False] * (len(first) - 1)
    for start in range(1, len(first)):
        node = start
        while not in_tree[node]:
            leaving[node] = first[node] + int(next(draws) * valence[node])
            node = heads[leaving[node]]
        node = start
        while not in_tree[node]:
            in_tree[node] = True
            node = heads[leaving[node]]
    return np.array(leaving, dtype=np.int64)


def _draws(seed: int, *, at_once: int) -> Iterator[float]:
    """Yield random numbers from 0 up to 1 without end."""
    generator = np.random.default_rng(seed)
    while True:
        yield from generator.random(at_once).tolist()
