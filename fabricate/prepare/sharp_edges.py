"""Sharp edges of a surface, and new triangles that keep them: points on the edges, and edges along them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from fabricate.arrays import Floats, Indices, Mask, frozen
from fabricate.mesh.crease import creased, fanned_corners
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.triangle_mesh import TriangleMesh, edges
from fabricate.triangles.adjacency import grown, neighbour_means
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.search_tree import SearchTree

NEAR = 0.4
"""How far a point may be from the sharp edge or the corner that it is put on, in the mean length of its edges."""

BEND = 40.0
"""A point where two sharp edges meet is a corner when they turn by more than so many degrees."""

ROUNDS = 12
"""How often points are moved where triangles lie over each other."""

OFF = 1e-3
"""How far the middle of an edge is from where it belongs, at most, as a share of its length."""

CHUNK = 2_000_000
"""Distances that are held at once."""


@dataclass(frozen=True, eq=False)
class SharpEdges:
    """Where a surface is sharp.

    Attributes
    ----------
    segments : (k, 2, 3) float
        The ends of each sharp edge, mm.
    corners : (c, 3) float
        Where sharp edges end, branch or turn, mm.
    """

    segments: Floats
    corners: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "segments", frozen(self.segments, np.float64, (None, 2, 3)))
        object.__setattr__(self, "corners", frozen(self.corners, np.float64, (None, 3)))

    @classmethod
    def of(cls, mesh: PolygonMesh, *, angle: float) -> SharpEdges:
        """Find the edges at which a closed mesh turns by `angle` degrees or more."""
        found = creased(mesh, angle=angle)
        ends = _crease_ends(found)
        return cls(mesh.points[ends], mesh.points[_corners(mesh.points, ends)])

    def nearest(self, places: Floats) -> Floats:
        """Return the place on the sharp edges, of which there is at least one, nearest to each of (q, 3), (q, 3)."""
        start, way = self.segments[:, 0], self.segments[:, 1] - self.segments[:, 0]
        squares = np.maximum(np.einsum("ij,ij->i", way, way), np.finfo(float).tiny)
        found = np.zeros_like(places)
        step = max(1, CHUNK // len(way))
        for begin in range(0, len(places), step):
            from_start = places[begin : begin + step, None] - start
            share = np.clip(np.einsum("qkj,kj->qk", from_start, way) / squares, 0.0, 1.0)
            gone = from_start - share[..., None] * way
            best = np.einsum("qkj,qkj->qk", gone, gone).argmin(axis=1)
            found[begin : begin + step] = start[best] + share[np.arange(len(best)), best, None] * way[best]
        return found


def sharpened(cells: TriangleMesh, surface: TriangleMesh, *, angle: float) -> PolygonMesh:
    """Return triangles that lie close to a surface with their points on it, and creases along its sharp edges.

    The nearest point goes to each corner, and points between two triangles that meet at `angle` degrees or more to the
    nearest sharp edge; unless that is far. A surface without sharp edges changes nothing.
    """
    sharp = SharpEdges.of(surface.polygons, angle=angle)
    if not len(sharp.segments):
        return cells.polygons
    points = np.array(SearchTree.of(surface.points, surface.triangles).nearest(cells.points).point)
    reach = NEAR * _mean_edges(cells)
    on_edges = np.unique(_crease_ends(creased(cells.polygons, angle=angle)))
    put = sharp.nearest(points[on_edges])
    near = np.linalg.norm(put - points[on_edges], axis=1) <= reach[on_edges]
    points[on_edges[near]] = put[near]
    for corner in sharp.corners:
        away = np.linalg.norm(points - corner, axis=1)
        nearest = int(away.argmin())
        if away[nearest] <= reach[nearest]:
            points[nearest] = corner
    put_right = _turned(replace(cells, points=points), surface, sharp)
    put_right = _unfolded(put_right, surface, sharp, angle=angle)
    return fanned_corners(creased(put_right.polygons, angle=angle))


def _turned(cells: TriangleMesh, surface: TriangleMesh, sharp: SharpEdges) -> TriangleMesh:
    """Return the cells with edges that cut across a sharp edge turned to lie along it, where both their ends would."""
    tree = SearchTree.of(surface.points, surface.triangles)
    for _ in range(ROUNDS):
        joined = edges(cells)
        length = joined.lengths(cells.points)
        across = tree.nearest(cells.points[joined.ends].mean(axis=1)).distance > OFF * length
        middles = cells.points[joined.opposite].mean(axis=1)
        along = np.linalg.norm(sharp.nearest(middles) - middles, axis=1) <= OFF * length
        count = len(cells.points)
        taken = np.isin(np.sort(joined.opposite, axis=1) @ [count, 1], joined.ends @ [count, 1])
        wanted = np.flatnonzero(across & along & ~taken)
        _, first = np.unique(joined.triangles[wanted].ravel(), return_index=True)
        alone = np.bincount(first // 2, minlength=len(wanted)) == 2
        wanted = wanted[alone]
        if not len(wanted):
            break
        (a, b), (c, d) = joined.ends[wanted].T, joined.opposite[wanted].T
        triangles = np.array(cells.triangles)
        triangles[joined.triangles[wanted, 0]] = np.stack([a, d, c], axis=1)
        triangles[joined.triangles[wanted, 1]] = np.stack([d, b, c], axis=1)
        cells = replace(cells, triangles=triangles)
    return cells


def _unfolded(cells: TriangleMesh, surface: TriangleMesh, sharp: SharpEdges, *, angle: float) -> TriangleMesh:
    """Return the cells with points around triangles that cross or overlap moved to the means of their neighbours.

    Those on a sharp edge go along it, and where edges end, branch or turn they stay.
    """
    means, tree = neighbour_means(cells.triangles, count=len(cells.points)), None
    for _ in range(ROUNDS):
        folded = np.unique(crossing_triangles(cells.points, cells.triangles))
        if not len(folded):
            break
        tree = tree or SearchTree.of(surface.points, surface.triangles)
        around: Mask = np.zeros(len(cells.points), dtype=bool)
        around[cells.triangles[folded]] = True
        around = grown(around, means, 1)
        ends = _crease_ends(creased(cells.polygons, angle=angle))
        fixed = _corners(cells.points, ends)
        along = np.setdiff1d(np.unique(ends), fixed)
        around[fixed] = False
        points = means @ cells.points
        both = np.concatenate([ends, ends[:, ::-1]])
        both = both[np.isin(both[:, 0], along)]
        both = both[np.argsort(both[:, 0], kind="stable")]
        points = tree.nearest(points).point
        points[along] = sharp.nearest(cells.points[both[:, 1]].reshape(-1, 2, 3).mean(axis=1))
        cells = replace(cells, points=np.where(around[:, None], points, cells.points))
    return cells


def _crease_ends(mesh: PolygonMesh) -> Indices:
    """Return the ends of each crease once, (k, 2) int."""
    tail, head = mesh.corners, mesh.corners[mesh.next_corner]
    ends: Indices = np.stack([tail, head], axis=1)[mesh.creases & (tail < head)]
    return ends


def _corners(points: Floats, ends: Indices) -> Indices:
    """Return the points at which sharp edges, (k, 2) int, end, branch or turn, (c,) int."""
    both = np.concatenate([ends, ends[:, ::-1]])
    both = both[np.argsort(both[:, 0], kind="stable")]
    used, counts = np.unique(both[:, 0], return_counts=True)
    ways = points[both[:, 1]] - points[both[:, 0]]
    ways /= np.maximum(np.linalg.norm(ways, axis=1, keepdims=True), np.finfo(float).tiny)
    pairs = np.cumsum(counts)[counts == 2]
    straight = -np.einsum("ij,ij->i", ways[pairs - 1], ways[pairs - 2])
    turning = used[counts == 2][straight < np.cos(np.radians(BEND))]
    return np.concatenate([used[counts != 2], turning])


def _mean_edges(cells: TriangleMesh) -> Floats:
    """Return the mean length of the edges at each point, (n,) float, mm."""
    corners = cells.points[cells.triangles]
    lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    at_corner = 0.5 * (lengths + np.roll(lengths, 1, axis=1))
    sums = np.bincount(cells.triangles.ravel(), at_corner.ravel(), minlength=len(cells.points))
    means: Floats = sums / np.maximum(cells.valence, 1)
    return means
