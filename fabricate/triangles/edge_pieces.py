"""Edges measured between their ends: how near a piece of one can come to a surface whose distance is known at both."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.triangles.search_tree import SearchTree


@dataclass(frozen=True, eq=False)
class EdgePieces:
    """Pieces of edges, their two ends and how far these are from another surface.

    Attributes
    ----------
    edges : (k,) int
        The edge that each piece is of.
    begins, ends : (k, 3) float
        mm.
    at_begin, at_end : (k,) float
        Distances of the ends from the other surface, mm.
    """

    edges: Indices
    begins: Floats
    ends: Floats
    at_begin: Floats
    at_end: Floats

    @classmethod
    def whole(cls, points: Floats, edges: Indices, distances: Floats) -> EdgePieces:
        """Return each of the edges, (k, 2) int, as one piece; `distances`, (n,), are those of all points."""
        begins, ends = edges.T
        return cls(np.arange(len(edges)), points[begins], points[ends], distances[begins], distances[ends])

    @property
    def least(self) -> Floats:
        """(k,) float: no place of a piece can be nearer to the other surface, mm.

        Where a piece is nearest between its ends, at s from one of them, the way to the other surface is at
        right angles to it; so the end's distance is at most that of the hypotenuse.
        """
        squared = np.maximum(np.einsum("ij,ij->i", self.ends - self.begins, self.ends - self.begins), 1e-300)
        share = np.clip(0.5 + 0.5 * (self.at_begin**2 - self.at_end**2) / squared, 0.0, 1.0)
        below = np.minimum(self.at_begin**2 - share**2 * squared, self.at_end**2)
        least: Floats = np.sqrt(np.maximum(below, 0.0))
        return least

    def chosen(self, which: Mask | Indices) -> EdgePieces:
        """Return some of the pieces."""
        return EdgePieces(
            self.edges[which], self.begins[which], self.ends[which], self.at_begin[which], self.at_end[which]
        )

    def halved(self, other: SearchTree) -> EdgePieces:
        """Return both halves of every piece, all first ones before all second ones."""
        middles = 0.5 * (self.begins + self.ends)
        at_middle = other.nearest(middles).distance
        return EdgePieces(
            np.concatenate([self.edges, self.edges]),
            np.concatenate([self.begins, middles]),
            np.concatenate([middles, self.ends]),
            np.concatenate([self.at_begin, at_middle]),
            np.concatenate([at_middle, self.at_end]),
        )


def near_edges(pieces: EdgePieces, other: SearchTree, *, reach: float, sure: float) -> Indices:
    """Return the numbers of the edges found within `reach` of the other surface between their ends, rising, (k,) int.

    Every edge that comes within `sure`, less than `reach`, is among them, both in mm; but for those with an end
    within `reach`, which are left out.
    """
    far = np.minimum(pieces.at_begin, pieces.at_end) >= reach
    pieces = pieces.chosen(far & (pieces.least < sure))
    found = [pieces.edges[:0]]
    while len(pieces.edges):
        count = len(pieces.edges)
        pieces = pieces.halved(other)
        near = pieces.at_begin[count:] < reach
        found.append(pieces.edges[:count][near])
        pieces = pieces.chosen(np.tile(~near, 2) & (pieces.least < sure))
    return np.unique(np.concatenate(found))
