"""The edge length asked for everywhere on a surface, and how it becomes smaller where detail needs it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from fabricate.arrays import Floats, Mask, frozen
from fabricate.prepare.triangle_mesh import TriangleMesh, edges
from fabricate.triangles.search_tree import SearchTree

REFINEMENT = 0.6
"""Factor by which edges become shorter in one go where they are too long."""

GRADING = 0.8
"""How much longer edges may become per mm along the surface: neighbouring triangles stay similar."""

SMALLEST = 1.0 / 12.0
"""Edges are asked to be no shorter than this share of the longest ones."""


@dataclass(frozen=True, eq=False)
class SizingField:
    """A closed surface, and the edge length asked for at each of its points.

    Attributes
    ----------
    surface : TriangleMesh
        n points.
    lengths : (n,) float
        mm.
    tree : SearchTree
        The triangles of the surface, for looking up places.
    """

    surface: TriangleMesh
    lengths: Floats
    tree: SearchTree

    def __post_init__(self) -> None:
        object.__setattr__(self, "lengths", frozen(self.lengths, np.float64, (len(self.surface.points),)))

    @classmethod
    def even(cls, surface: TriangleMesh, *, length: float) -> SizingField:
        """Ask for the same length, mm, everywhere."""
        lengths = np.full(len(surface.points), length)
        return cls(surface, lengths, SearchTree.of(surface.points, surface.triangles))

    def at(self, places: Floats) -> Floats:
        """Return the length asked for near each place, (k, 3), as (k,) float, mm."""
        nearest = self.tree.nearest(places)
        asked: Floats = self.lengths[self.surface.triangles[nearest.triangle]].mean(axis=1)
        return asked

    def refined(self, where: Mask) -> SizingField:
        """Return the field with shorter edges at some points of the surface, (n,) bool, and graded ones round them."""
        floor = SMALLEST * float(self.lengths.max())
        lengths = np.where(where, np.maximum(REFINEMENT * self.lengths, floor), self.lengths)
        return replace(self, lengths=_graded(self.surface, lengths))


def _graded(surface: TriangleMesh, lengths: Floats) -> Floats:
    """Return the largest lengths that are nowhere above those given and grow slowly enough.

    That is the shortest path to each point from one node that every point is joined to by its own length, where
    edges of the surface count by how much the length may grow along them.
    """
    joined, count = edges(surface), len(lengths)
    growth = np.maximum(GRADING * joined.lengths(surface.points), np.finfo(float).tiny)
    (a, b), node = joined.ends.T, np.full(count, count)
    rows, columns = np.concatenate([a, b, node]), np.concatenate([b, a, np.arange(count)])
    graph = coo_array((np.concatenate([growth, growth, lengths]), (rows, columns)), shape=(count + 1, count + 1))
    graded: Floats = dijkstra(graph.tocsr(), indices=[count])[0, :count]
    return graded
