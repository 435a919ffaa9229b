"""Short loops round handles and through holes: closed ways on a surface that do not part it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import dijkstra

from fabricate.arrays import Floats, Indices, Words
from fabricate.prepare.homology import edge_words
from fabricate.prepare.triangle_mesh import Edges, TriangleMesh, edges
from fabricate.triangles.normals import vertex_normals
from fabricate.triangles.ray_casting import first_hits

SPACING = 1.0 / 6.0
"""Distance between the places from which loops are looked for, as a share of the longest loop."""

START = 1e-3
"""How far from the surface a ray begins, mm."""

SOURCES = 64
"""Ways are looked for from so many places at once: each takes a row as long as the surface has points."""


class Loop(NamedTuple):
    """A closed way along edges, without a point twice.

    Attributes
    ----------
    length : float
        mm.
    points : (k,) int
    word : bytes
        The same for loops that bound a part of the surface together (see `homology`).
    """

    length: float
    points: Indices
    word: bytes


def short_loops(surface: TriangleMesh, *, across: float, longest: float) -> list[Loop]:
    """Return loops up to `longest` mm that do not part a closed, connected surface, the shortest one first.

    They are the shortest of those through points where no more than `across`, mm, of body or of hole is under or over
    the surface: a point of every small cube of space, and at most one loop through each.

    References
    ----------
    J. Erickson, S. Har-Peled, "Optimally cutting a surface into a disk", Discrete & Computational Geometry 31, 2004:
    the shortest such loop through a point is two shortest ways and an edge.
    """
    places = _narrow_places(surface, across=across, spacing=SPACING * longest)
    ways, found = _Ways.of(surface), list[Loop]()
    for begin in range(0, len(places), SOURCES):
        sources = places[begin : begin + SOURCES]
        reached = dijkstra(ways.graph, directed=False, indices=sources, limit=longest / 2.0, return_predecessors=True)
        for source, distance, before in zip(sources, *reached, strict=True):
            loop = ways.loop(int(source), distance, before.astype(np.int64), longest=longest)
            if loop is not None:
                found.append(loop)
    return sorted(found, key=lambda loop: loop.length)


def _narrow_places(surface: TriangleMesh, *, across: float, spacing: float) -> Indices:
    """Return points where there is no more than `across`, mm, of body or of hole, one for each small cube of space."""
    normals = vertex_normals(surface.points, surface.triangles)
    reach = np.full(len(surface.points), np.inf)
    for way in (normals, -normals):
        hits = first_hits(surface.points, surface.triangles, surface.points + START * way, way)
        reach = np.minimum(reach, hits.distance)
    narrow = np.flatnonzero(reach <= across)
    cubes = np.floor(surface.points[narrow] / spacing).astype(np.int64)
    places: Indices = narrow[np.unique(cubes, axis=0, return_index=True)[1]]
    return places


@dataclass(frozen=True, eq=False)
class _Ways:
    """The edges of a surface as a graph, weighted by length and, again, by their numbers from 1."""

    joined: Edges
    lengths: Floats
    words: Words
    graph: csr_array
    numbers: csr_array

    @classmethod
    def of(cls, surface: TriangleMesh) -> _Ways:
        joined, count = edges(surface), len(surface.points)
        lengths = joined.lengths(surface.points)
        graph, numbers = (
            csr_array(coo_array((values, tuple(joined.ends.T)), shape=(count, count)))
            for values in (np.maximum(lengths, np.finfo(float).tiny), np.arange(1, len(lengths) + 1))
        )
        return cls(joined, lengths, edge_words(surface), graph, numbers)

    def loop(self, source: int, distance: Floats, before: Indices, *, longest: float) -> Loop | None:
        """Return the shortest loop through a point, from the shortest ways to it, if it is short enough."""
        ends = self.joined.ends
        whole = distance[ends].sum(axis=1) + self.lengths
        on_tree = (before[ends] == ends[:, ::-1]).any(axis=1)
        closing = np.flatnonzero((whole <= longest) & ~on_tree)
        words = self.words[closing]
        for side in (0, 1):
            words = words ^ self._words_from(source, ends[closing, side], before)
        around = np.flatnonzero(words.any(axis=1))
        if not len(around):
            return None
        best = around[whole[closing[around]].argmin()]
        points = _closed_way(*(_way(int(end), before, source) for end in ends[closing[best]]))
        return Loop(float(whole[closing[best]]), points, words[best].tobytes())

    def _words_from(self, source: int, places: Indices, before: Indices) -> Words:
        """Return the words of the ways from the source to some points, (k, w) uint64."""
        sums = np.zeros((len(places), self.words.shape[1]), dtype=np.uint64)
        here = np.array(places)
        while len(on_way := np.flatnonzero(here != source)):
            ends = np.sort(np.stack([here[on_way], before[here[on_way]]], axis=1), axis=1)
            sums[on_way] ^= self.words[np.asarray(self.numbers[ends[:, 0], ends[:, 1]]).ravel() - 1]
            here[on_way] = before[here[on_way]]
        return sums


def _way(point: int, before: Indices, source: int) -> list[int]:
    """Return the points on the way back to the source, both ends with them."""
    way = [point]
    while way[-1] != source:
        way.append(int(before[way[-1]]))
    return way


def _closed_way(there: list[int], back: list[int]) -> Indices:
    """Return the points of two ways to one source as a loop, without the part that they have in common."""
    while len(there) > 1 and len(back) > 1 and there[-2] == back[-2]:
        there, back = there[:-1], back[:-1]
    return np.array(there + back[-2::-1], dtype=np.int64)
