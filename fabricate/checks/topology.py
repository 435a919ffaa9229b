"""Topology of a part: whether its triangles are the boundary of one solid, from their connections alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fabricate.arrays import Floats, Indices, Mask, frozen
from fabricate.checks.check import Check
from fabricate.checks.wording import counted
from fabricate.solid.part import Part
from fabricate.triangles.normals import area_vectors


@dataclass(frozen=True, eq=False)
class Edges:
    """The half-edges of a part, grouped by the edge that they lie on.

    Half-edge 3 t + k runs from corner k of triangle t to its next corner.

    Attributes
    ----------
    begins, ends : (3 m,) int
        The two points of each half-edge.
    order : (3 m,) int
        All half-edges, those on one edge next to each other.
    firsts : (e,) int
        Where each edge's half-edges begin in `order`.
    """

    begins: Indices
    ends: Indices
    order: Indices
    firsts: Indices

    def __post_init__(self) -> None:
        for name in ("begins", "ends", "order", "firsts"):
            object.__setattr__(self, name, frozen(getattr(self, name), np.int64, (None,)))

    @classmethod
    def of(cls, part: Part) -> Edges:
        """Group the half-edges of a part."""
        begins, ends = part.triangles.ravel(), np.roll(part.triangles, -1, axis=1).ravel()
        keys = np.minimum(begins, ends) * len(part.points) + np.maximum(begins, ends)
        order = np.argsort(keys, kind="stable")
        is_first = np.diff(keys[order], prepend=-1) != 0
        return cls(begins, ends, order, np.flatnonzero(is_first))

    @property
    def counts(self) -> Indices:
        """(e,) int: number of half-edges on each edge."""
        return np.diff(self.firsts, append=len(self.order))

    @property
    def pairs(self) -> Indices:
        """(i, 2) int: the two half-edges on each edge that has exactly two."""
        firsts = self.firsts[self.counts == 2]
        return np.column_stack([self.order[firsts], self.order[firsts + 1]])

    def middles(self, points: Floats, half_edges: Indices) -> Floats:
        """(k, 3) float: the middles of half-edges."""
        middles: Floats = 0.5 * (points[self.begins[half_edges]] + points[self.ends[half_edges]])
        return middles


@dataclass(frozen=True, eq=False)
class Topology:
    """What a part's connections are, and the checks of them.

    Attributes
    ----------
    watertight : bool
        Whether every edge has two triangles, once in each direction.
    components : int
        Connected pieces.
    genus : int or None
        Handles, those of all pieces together; None where the surface is not a closed manifold.
    checks : tuple of Check
    """

    watertight: bool
    components: int
    genus: int | None
    checks: tuple[Check, ...]


def topology(part: Part, *, expected_genus: int | None) -> Topology:
    """Find out and check how the triangles of a part are connected."""
    edges = Edges.of(part)
    labels = component_labels(part, edges)
    components = int(labels.max(initial=-1)) + 1
    closed, oriented = closed_check(part, edges), oriented_check(part, edges)
    fans = vertex_manifold_check(part, edges)
    proved = closed.ok and oriented.ok and fans.ok
    genus = manifold_genus(part, edges, components=components) if proved else None
    return Topology(
        closed.ok and oriented.ok,
        components,
        genus,
        (
            closed,
            oriented,
            fans,
            components_check(part, labels),
            nondegenerate_check(part),
            genus_check(part, genus, expected=expected_genus),
        ),
    )


def closed_check(part: Part, edges: Edges) -> Check:
    """Check that every edge has exactly two triangles; points at the middles of those that don't."""
    wrong = edges.counts != 2
    code = f"{part.name}.closed"
    if not len(part.triangles):
        return Check(code, ok=False, message=f"a closed surface was expected, but {part.name} is empty")
    if not wrong.any():
        return Check(code, ok=True, message=f"all {len(wrong)} edges of {part.name} have two triangles")
    open_edges = int((edges.counts == 1).sum())
    return Check(
        code,
        ok=False,
        message=f"every edge of {part.name} must have exactly two triangles, "
        f"but {open_edges} of {len(wrong)} have one and {int(wrong.sum()) - open_edges} have more than two",
        where=edges.middles(part.points, edges.order[edges.firsts[wrong]]),
    )


def oriented_check(part: Part, edges: Edges) -> Check:
    """Check that the two triangles on an edge run along it in opposite directions; points at its middle."""
    pairs = edges.pairs
    wrong = edges.begins[pairs[:, 0]] == edges.begins[pairs[:, 1]]
    code = f"{part.name}.oriented"
    if not wrong.any():
        return Check(code, ok=True, message=f"neighbouring triangles of {part.name} face the same way")
    return Check(
        code,
        ok=False,
        message=f"neighbouring triangles of {part.name} must face the same way, "
        f"but they don't at {counted(int(wrong.sum()), 'edge')}",
        where=edges.middles(part.points, pairs[wrong, 0]),
    )


def vertex_manifold_check(part: Part, edges: Edges) -> Check:
    """Check that the triangles round every vertex form one fan; points at the vertices that join several."""
    fans = _fans(part, edges)
    pinched = np.flatnonzero(fans > 1)
    code = f"{part.name}.vertex_manifold"
    if not len(pinched):
        return Check(code, ok=True, message=f"each vertex of {part.name} has one fan of triangles")
    return Check(
        code,
        ok=False,
        message=f"each vertex of {part.name} must have one fan of triangles, "
        f"but {counted(len(pinched), 'vertex', 'vertices')} of {len(part.points)} have up to {fans.max()}",
        where=part.points[pinched],
    )


def components_check(part: Part, labels: Indices) -> Check:
    """Check that the part is one piece, given `component_labels`; points at one vertex of each piece."""
    firsts = np.unique(labels, return_index=True)[1]
    code = f"{part.name}.components"
    if len(firsts) == 1:
        return Check(code, ok=True, message=f"{part.name} is one piece")
    return Check(
        code,
        ok=False,
        message=f"{part.name} must be one piece, but it is {len(firsts)}",
        where=part.points[part.triangles[firsts, 0]],
    )


def nondegenerate_check(part: Part) -> Check:
    """Check that every triangle has three different corners and an area; points at centroids."""
    flat: Mask = (area_vectors(part.points, part.triangles) == 0.0).all(
        axis=1
    )  # repeated corners give an exact zero, too
    code = f"{part.name}.nondegenerate"
    if not flat.any():
        return Check(code, ok=True, message=f"all {len(flat)} triangles of {part.name} have an area")
    return Check(
        code,
        ok=False,
        message=f"every triangle of {part.name} must have an area, but {flat.sum()} of {len(flat)} have none",
        where=part.points[part.triangles[flat]].mean(axis=1),
    )


def genus_check(part: Part, genus: int | None, *, expected: int | None) -> Check:
    """Check that the part has as many handles as expected; skipped if either number is not known."""
    code = f"{part.name}.genus"
    if genus is None:
        message = f"{part.name} is not a closed manifold, so it has no genus"
        return Check(code, ok=False, skipped=True, message=message)
    if expected is None:
        message = f"{part.name} has genus {genus}; none was expected"
        return Check(code, ok=False, skipped=True, message=message)
    return Check(code, ok=genus == expected, message=f"{part.name} must have genus {expected}, and it has {genus}")


def component_labels(part: Part, edges: Edges) -> Indices:
    """Return for each triangle the number of the piece that it belongs to, (m,) int, counted from 0.

    Triangles that share a vertex by number belong together.
    """
    labels = _components(len(part.points), edges.begins, edges.ends)[part.triangles[:, 0]]
    return np.unique(labels, return_inverse=True)[1]  # points without triangles are no pieces


def manifold_genus(part: Part, edges: Edges, *, components: int) -> int:
    """Return the number of handles from V - E + F = 2 (components - genus).

    It is one only for a closed, oriented manifold; the handles of several components are summed.
    """
    vertices = int(np.count_nonzero(np.bincount(part.triangles.ravel())))
    return components - (vertices - len(edges.firsts) + len(part.triangles)) // 2


def _fans(part: Part, edges: Edges) -> Indices:
    """Return the number of fans at each vertex: its corners, joined across edges with two triangles."""
    first, second = edges.pairs.T
    after_first, after_second = _next(first), _next(second)
    agree = edges.begins[first] != edges.begins[second]
    count = len(edges.begins)
    labels = _components(
        count,
        np.concatenate([first, after_first]),
        np.concatenate([np.where(agree, after_second, second), np.where(agree, second, after_second)]),
    )
    vertex = np.full(labels.max(initial=-1) + 1, -1)
    vertex[labels] = edges.begins  # all corners of a fan have the same vertex
    return np.bincount(vertex, minlength=len(part.points))


def _next(half_edges: Indices) -> Indices:
    """Return the half-edges that follow in the same triangles."""
    following: Indices = half_edges + 1 - 3 * (half_edges % 3 == 2)
    return following


def _components(nodes: int, begins: Indices, ends: Indices) -> Indices:
    """Return the number of the connected component that each node lies in."""
    graph = coo_array((np.ones(len(begins)), (begins, ends)), shape=(nodes, nodes))
    return connected_components(graph, directed=False)[1].astype(np.int64)
