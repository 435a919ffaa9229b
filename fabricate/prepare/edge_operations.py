"""Edges of a closed triangle mesh split, collapsed and flipped, many at a time; the topology always stays.

Operations of one pass touch disjoint neighbourhoods, so that each of them may be judged by the mesh as it was.
"""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.prepare.tangent_planes import TangentPlanes
from fabricate.prepare.triangle_mesh import Edges, TriangleMesh, adjacency, edges
from fabricate.triangles.normals import area_vectors, unit

TOO_LONG, TOO_SHORT = 4.0 / 3.0, 4.0 / 5.0
"""Edges that leave this range of the length asked for are split or collapsed: halves of a split edge don't collapse."""

LARGEST_TURN = 0.2
"""Cosine of the largest angle, 78 degrees, by which an operation may turn a triangle: none folds over."""

SMALLEST_SHARE = 1e-3
"""An operation may leave a triangle no less of its area than this."""

FLATTEST_FLIP = 0.5
"""Cosine of the largest angle, 60 degrees, between two triangles across whose edge one may still flip."""

LARGEST_VALENCE = 10


def split_long_edges(mesh: TriangleMesh, lengths: Floats) -> tuple[TriangleMesh, Floats]:
    """Return the mesh with edges that are too long halved, and the lengths asked for, one at each of its points.

    One pass: of neighbouring long edges only the longest is split.

    Parameters
    ----------
    mesh : TriangleMesh
        n points.
    lengths : (n,) float
        Edge length asked for at each point, mm.
    """
    joined = edges(mesh)
    ratio = joined.lengths(mesh.points) / lengths[joined.ends].mean(axis=1)
    rank = _ranks(-ratio)
    first = rank[joined.of_triangle].min(axis=1)
    chosen = (ratio > TOO_LONG) & (rank[:, None] == first[joined.triangles]).all(axis=1)
    a, b = joined.ends[chosen].T
    c, d = joined.opposite[chosen].T
    middle = len(mesh.points) + np.arange(len(a))
    triangles = np.array(mesh.triangles)
    triangles[joined.triangles[chosen, 0]] = np.stack([a, middle, c], axis=1)
    triangles[joined.triangles[chosen, 1]] = np.stack([b, middle, d], axis=1)
    added = [np.stack([middle, b, c], axis=1), np.stack([middle, a, d], axis=1)]
    points = np.concatenate([mesh.points, 0.5 * (mesh.points[a] + mesh.points[b])])
    wanted = np.concatenate([lengths, 0.5 * (lengths[a] + lengths[b])])
    return TriangleMesh(points, np.concatenate([triangles, *added])), wanted


def collapse_short_edges(mesh: TriangleMesh, lengths: Floats, rng: np.random.Generator) -> tuple[TriangleMesh, Floats]:
    """Return the mesh with edges that are too short shrunk to a point, and the lengths asked for at its points.

    One pass. An edge stays if shrinking it would change the topology (the link condition of Dey, Edelsbrunner,
    Guha and Nekhayev 1999), turn a triangle over or make an edge that is too long.

    Parameters
    ----------
    mesh : TriangleMesh
        n points.
    lengths : (n,) float
        Edge length asked for at each point, mm.
    rng : numpy.random.Generator
        Which of neighbouring edges goes first is half chance: one that has to stay must not bar others for ever.
    """
    joined = edges(mesh)
    ratio = joined.lengths(mesh.points) / lengths[joined.ends].mean(axis=1)
    candidates = np.flatnonzero(ratio < TOO_SHORT)
    candidates = candidates[_keeps_topology(mesh, joined, candidates)]
    candidates = candidates[
        _apart(mesh, joined, candidates, ratio[candidates] * rng.uniform(0.5, 1.5, len(candidates)))
    ]
    place = TangentPlanes.of(mesh).nearest(joined.ends[candidates], mesh.points[joined.ends[candidates]].mean(axis=1))
    kept = _keeps_shape(mesh, joined.ends[candidates], place, lengths)
    (a, b), chosen = joined.ends[candidates[kept]].T, candidates[kept]
    points, wanted = np.array(mesh.points), np.array(lengths)
    points[a], wanted[a] = place[kept], 0.5 * (wanted[a] + wanted[b])
    return _without(TriangleMesh(points, mesh.triangles), a, b, joined.triangles[chosen]), np.delete(wanted, b)


def flip_edges(mesh: TriangleMesh) -> TriangleMesh:
    """Return the mesh with edges turned to the other diagonal where that brings valences nearer to 6; one pass."""
    joined = edges(mesh)
    away = mesh.valence[np.concatenate([joined.ends, joined.opposite], axis=1)] - 6
    change = np.array([-1, -1, 1, 1])
    gain = np.square(away).sum(axis=1) - np.square(away + change).sum(axis=1)
    candidates = np.flatnonzero((gain > 0) & (away[:, :2] > -3).all(axis=1))
    candidates = candidates[_flips_well(mesh, joined, candidates)]
    rank = _ranks(-gain[candidates].astype(np.float64))
    corners = np.concatenate([joined.ends[candidates], joined.opposite[candidates]], axis=1)
    first = _first_at(len(mesh.points), corners, rank)
    chosen = candidates[(first[corners] == rank[:, None]).all(axis=1)]
    (a, b), (c, d) = joined.ends[chosen].T, joined.opposite[chosen].T
    triangles = np.array(mesh.triangles)
    triangles[joined.triangles[chosen, 0]] = np.stack([a, d, c], axis=1)
    triangles[joined.triangles[chosen, 1]] = np.stack([d, b, c], axis=1)
    return TriangleMesh(mesh.points, triangles)


def _keeps_topology(mesh: TriangleMesh, joined: Edges, candidates: Indices) -> Mask:
    """Return whether the ends of each edge share exactly the two points opposite it, which keep 3 triangles."""
    beside = adjacency(mesh, joined)
    a, b = joined.ends[candidates].T
    shared = np.asarray(beside[a].multiply(beside[b]).sum(axis=1)).ravel()
    valence = mesh.valence
    round_opposite = valence[joined.opposite[candidates]].min(axis=1, initial=4)
    merged = valence[a] + valence[b] - 4
    kept: Mask = (shared == 2) & (round_opposite >= 4) & (merged >= 3) & (merged <= LARGEST_VALENCE)
    return kept


def _keeps_shape(mesh: TriangleMesh, ends: Indices, place: Floats, lengths: Floats) -> Mask:
    """Return whether shrinking the edges, (k, 2), to the places, (k, 3), turns no triangle and makes no long edge."""
    a, b = ends.T
    fans = mesh.fans
    around = fans[a] + fans[b]  # 2 at the two triangles that vanish
    edge = np.repeat(np.arange(len(ends)), np.diff(around.indptr))[around.data == 1.0]
    corners = mesh.triangles[around.indices[around.data == 1.0]]
    moves = (corners == a[edge, None]) | (corners == b[edge, None])
    before = mesh.points[corners]
    after = np.where(moves[..., None], place[edge, None], before)
    longest = TOO_LONG * lengths[ends].mean(axis=1)
    bad = _turned(before, after) | (
        np.linalg.norm(before - place[edge, None], axis=2) * ~moves > longest[edge, None]
    ).any(axis=1)
    kept: Mask = np.bincount(edge[bad], minlength=len(ends)) == 0
    return kept


def _without(mesh: TriangleMesh, kept: Indices, gone: Indices, vanished: Indices) -> TriangleMesh:
    """Return the mesh with each point of `gone` merged into its fellow of `kept`, and some triangles left out."""
    renamed = np.arange(len(mesh.points))
    renamed[gone] = kept
    alive = np.ones(len(mesh.points), dtype=np.int64)
    alive[gone] = 0
    number = np.cumsum(alive) - 1
    triangles = number[renamed[np.delete(mesh.triangles, vanished.ravel(), axis=0)]]
    return TriangleMesh(np.delete(mesh.points, gone, axis=0), triangles)


def _flips_well(mesh: TriangleMesh, joined: Edges, candidates: Indices) -> Mask:
    """Return whether each edge lies between two fairly flat triangles, and the other diagonal is no edge yet."""
    (a, b), (c, d) = joined.ends[candidates].T, joined.opposite[candidates].T
    taken = np.isin(_keys(mesh, joined.opposite[candidates]), _keys(mesh, joined.ends))
    normal = unit(area_vectors(mesh.points, mesh.triangles))[joined.triangles[candidates]]
    flat = np.einsum("ij,ij->i", normal[:, 0], normal[:, 1]) > FLATTEST_FLIP
    mean = unit(normal.sum(axis=1))
    upright = np.ones(len(candidates), dtype=bool)
    for new in (np.stack([a, d, c], axis=1), np.stack([d, b, c], axis=1)):
        upright &= np.einsum("ij,ij->i", unit(area_vectors(mesh.points, new)), mean) > FLATTEST_FLIP
    kept: Mask = ~taken & flat & upright & (c != d)
    return kept


def _apart(mesh: TriangleMesh, joined: Edges, candidates: Indices, ratio: Floats) -> Mask:
    """Return which edges to collapse at once: no two are joined by an edge, or opposite the same point."""
    rank = _ranks(ratio)
    count = len(mesh.points)
    ends, opposite = joined.ends[candidates], joined.opposite[candidates]
    near = _first_at(count, ends, rank)
    around = near.copy()
    for k in range(2):
        np.minimum.at(around, joined.ends[:, k], near[joined.ends[:, 1 - k]])
    across = _first_at(count, opposite, rank)
    chosen: Mask = (around[ends] == rank[:, None]).all(axis=1) & (across[opposite] == rank[:, None]).all(axis=1)
    return chosen


def _turned(before: Floats, after: Floats) -> Mask:
    """Return which triangles, (k, 3, 3), turn by more than the largest angle or lose their area; one without may."""
    old, new = (np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) for corners in (before, after))
    old_area, new_area = np.linalg.norm(old, axis=1), np.linalg.norm(new, axis=1)
    turned: Mask = np.einsum("ij,ij->i", old, new) < LARGEST_TURN * old_area * new_area
    turned |= new_area < SMALLEST_SHARE * old_area
    return turned


def _keys(mesh: TriangleMesh, ends: Indices) -> Indices:
    """Return a number, (k,) int, for each pair of points that is the same for no other pair."""
    keys: Indices = ends.min(axis=1, initial=len(mesh.points)) * len(mesh.points) + ends.max(axis=1, initial=0)
    return keys


def _ranks(keys: Floats) -> Indices:
    """Return each key's place in ascending order; of equal keys the earlier one comes first."""
    rank = np.zeros(len(keys), dtype=np.int64)
    rank[np.argsort(keys, kind="stable")] = np.arange(len(keys))
    return rank


def _first_at(count: int, points: Indices, rank: Indices) -> Indices:
    """Return the lowest rank, (count,) int, among the rows of `points`, (k, c), that each point appears in."""
    first = np.full(count, np.iinfo(np.int64).max)
    np.minimum.at(first, points, np.broadcast_to(rank[:, None], points.shape))
    return first
