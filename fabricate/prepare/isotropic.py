"""Nearly equilateral triangles on a surface, with an edge length asked for at every place of it."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from fabricate.arrays import Floats
from fabricate.prepare.edge_operations import collapse_short_edges, flip_edges, split_long_edges
from fabricate.prepare.sizing_field import SizingField
from fabricate.prepare.tangent_planes import TangentPlanes
from fabricate.prepare.triangle_mesh import TriangleMesh, edges
from fabricate.triangles.adjacency import neighbour_means
from fabricate.triangles.normals import area_vectors, unit, vertex_normals

GROWTH = 1.5
"""Edges grow by this factor from round to round, so that the points lie on the surface at every scale."""

LAST_ROUNDS = 5
"""Rounds at the full length; the median edge no longer changes by a percent after them."""

MOST_PASSES, FEW = 30, 0.005
"""Passes of one kind in a round end when so small a share of the points comes or goes; the next round goes on."""

FLIP_PASSES = 3

STEP = 0.7
"""Share of the way to the mean of its neighbours that a point goes in a round."""

LARGEST_TILT = 0.5
"""Cosine of the largest angle, 60 degrees, by which moving points may turn a triangle in a round."""


def isotropic(field: SizingField, *, start: TriangleMesh, seed: int) -> TriangleMesh:
    """Return nearly equilateral triangles with their points on the surface and edges about as long as asked for.

    The topology is that of `start`. Edges stay shorter where collapsing one would change it.

    Parameters
    ----------
    field : SizingField
        The surface, and the edge length asked for everywhere on it.
    start : TriangleMesh
        The surface itself, or other triangles on it to begin with.
    seed : int
        Which of neighbouring edges is collapsed first is half chance.

    References
    ----------
    M. Botsch, L. Kobbelt, "A remeshing approach to multiresolution modeling", SGP 2004. There the operations of
    a round run edge by edge; here they run in passes over all edges, and edges grow from round to round.
    """
    rng = np.random.default_rng(seed)
    longest = float(field.lengths.max())
    length = min(longest, GROWTH * float(np.median(edges(start).lengths(start.points))))
    mesh, rounds = start, 0
    while rounds < LAST_ROUNDS:
        rounds += length == longest
        mesh = _round(mesh, field, rng, longest=length)
        length = min(longest, GROWTH * length)
    return mesh


def _round(mesh: TriangleMesh, field: SizingField, rng: np.random.Generator, *, longest: float) -> TriangleMesh:
    lengths = np.minimum(field.at(mesh.points), longest)
    mesh, lengths = _repeated(split_long_edges, mesh, lengths)
    mesh, _ = _repeated(partial(collapse_short_edges, rng=rng), mesh, lengths)
    for _ in range(FLIP_PASSES):
        mesh = flip_edges(mesh)
    return _relaxed(mesh, field)


def _repeated(
    operation: Callable[[TriangleMesh, Floats], tuple[TriangleMesh, Floats]], mesh: TriangleMesh, lengths: Floats
) -> tuple[TriangleMesh, Floats]:
    for _ in range(MOST_PASSES):
        before = len(mesh.points)
        mesh, lengths = operation(mesh, lengths)
        if abs(len(mesh.points) - before) <= FEW * before:
            break
    return mesh, lengths


def _relaxed(mesh: TriangleMesh, field: SizingField) -> TriangleMesh:
    """Return the mesh with its points moved towards the mean of their neighbours, along the surface."""
    way = neighbour_means(mesh.triangles, count=len(mesh.points)) @ mesh.points - mesh.points
    every_point = np.arange(len(mesh.points))[:, None]
    goals = TangentPlanes.of(mesh).nearest(every_point, mesh.points + STEP * way)
    nearest = field.tree.nearest(goals)
    facing = unit(area_vectors(field.surface.points, field.surface.triangles))[nearest.triangle]
    # the nearest place of a point within a thin wall may lie on the wall's other side
    same_side = np.einsum("ij,ij->i", facing, vertex_normals(mesh.points, mesh.triangles)) > 0.0
    return _unfolded(mesh, np.where(same_side[:, None], nearest.point, mesh.points))


def _unfolded(mesh: TriangleMesh, points: Floats) -> TriangleMesh:
    """Return the mesh on new points, apart from those whose move would turn a triangle too far."""
    points = np.array(points)
    before = area_vectors(mesh.points, mesh.triangles)
    while True:
        after = area_vectors(points, mesh.triangles)
        sizes = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
        folded = mesh.triangles[np.einsum("ij,ij->i", before, after) < LARGEST_TILT * sizes]
        folded = folded[(points[folded] != mesh.points[folded]).any(axis=(1, 2))]
        if not len(folded):
            return TriangleMesh(points, mesh.triangles)
        points[folded] = mesh.points[folded]
