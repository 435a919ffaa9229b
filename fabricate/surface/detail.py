"""Detail: the tessellated smooth surface carried onto the surface that it stands for.

In each round every point learns where it belongs on the target, the field of moves is smoothed, the less the later the
round, and the surface takes as much of that step as keeps it embedded. So it stretches into ears and fingers that the
smooth surface lacks before it takes on fine detail, and where its own sheets are in each other's way it stays smooth.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from fabricate.arrays import Floats, Indices, frozen
from fabricate.surface.deviation import spread
from fabricate.surface.embedding import Embedding
from fabricate.surface.smoothing import diffused, low_pass, passes_over, steadied
from fabricate.surface.stepping import stepped, untangled
from fabricate.surface.target import Target
from fabricate.triangles.adjacency import grown, neighbour_distances
from fabricate.triangles.normals import unit, vertex_normals
from fabricate.triangles.search_tree import SearchTree

SCHEDULE = (20, 10, 4, 2, 0)
"""How often the moves are smoothed in each round."""

LATE, MISSED, PLACES = (2, 1, 0), 0.001, 20_000
"""The rounds added where more than such a share of the target, seen at so many places, is missed by more than `ASTRAY`.
What was held back because others were in the way comes nearer once these have moved."""

REACH = 0.12
"""How far a point may move in a round, as a share of the bounding box's diagonal."""

SLIDES = 5
"""How often points slide within the surface, in a round, towards where their neighbours moved."""

ASTRAY, AROUND, FILLING = 0.5, 2, 100
"""Distance from the target from which a point did not reach it, mm; how many rings around such points are smoothed
with them; and how often these become the mean of what is around."""

NOISE = 0.5
"""Length over which the base's normals are evened out, mm: those of crowded points are no better than their places."""

WALL = 2.0
"""Length below which the surface under the detail is smooth, unless asked otherwise, mm."""


@dataclass(frozen=True, eq=False)
class Carried:
    """A smooth surface that took on the detail of another, point by point.

    Attributes
    ----------
    points : (n, 3) float
        On the other surface wherever that can be without crossings or folds; float32-exact, mm.
    base, base_normals : (n, 3) float
        The same shape without its fine detail, mm, and its unit outward normals: what an inner wall follows.
    """

    points: Floats
    base: Floats
    base_normals: Floats

    def __post_init__(self) -> None:
        for name in ("points", "base", "base_normals"):
            object.__setattr__(self, name, frozen(getattr(self, name), np.float64, (len(self.points), 3)))


def carried(
    points: Floats,
    normals: Floats,
    triangles: Indices,
    onto_points: Floats,
    onto_triangles: Indices,
    *,
    smoothing: float = WALL,
) -> Carried:
    """Carry a closed surface onto another of the same shape, in the same place, and keep it embedded.

    Parameters
    ----------
    points, normals : (n, 3) float
        The smooth surface, mm, and its unit outward normals.
    triangles : (m, 3) int
        Of the smooth surface, outward.
    onto_points, onto_triangles : (k, 3) float and (l, 3) int
        The other surface, mm, closed and outward. It may cross itself; the result does not.
    smoothing : float
        The base varies over no less than about this length, mm.

    Raises
    ------
    SolidError
        If the smooth surface crosses itself, and relaxing it there does not help.
    """
    embedding = Embedding.of(triangles, count=len(points))
    target = Target.of(onto_points, onto_triangles)
    reach = REACH * float(np.linalg.norm(np.ptp(onto_points, axis=0)))

    def drawn(outer: Floats, normals: Floats, schedule: Sequence[int]) -> Floats:
        for passes in schedule:
            slid = _slid(outer, points, normals, embedding.means)
            aims = target.aims(slid, normals, reach=reach)
            spacing = neighbour_distances(slid, triangles)
            moved = slid + steadied(aims.place - slid, aims.weight, embedding.means, spacing, passes=passes)
            outer = stepped(outer, moved, embedding.means, embedding.faults_since(outer))
            normals = _steady_normals(outer, embedding)
        return outer

    outer = drawn(untangled(points, embedding.means, embedding.crossed), normals, SCHEDULE)
    outer = _smooth_where_astray(outer, points, embedding, target)
    if _missed(outer, triangles, target) > MISSED:
        outer = drawn(outer, _steady_normals(outer, embedding), LATE)
    edge = float(np.median(np.linalg.norm(points[triangles[:, 0]] - points[triangles[:, 1]], axis=1)))
    smooth = points + low_pass(outer - points, embedding.means, passes=passes_over(smoothing, edge))
    base = stepped(outer, smooth, embedding.means, embedding.faults_since(outer))
    return Carried(outer, base, unit(diffused(vertex_normals(base, triangles), base, triangles, length=NOISE)))


def _slid(points: Floats, start: Floats, normals: Floats, means: csr_array) -> Floats:
    """Return the points slid within the surface until they moved from `start` much as their neighbours did.

    Moves are evened out, not places, so the pattern keeps its proportions.
    """
    for _ in range(SLIDES):
        move = points - start
        way = means @ move - move
        way -= np.einsum("ij,ij->i", way, normals)[:, None] * normals
        points = points + 0.5 * way
    return points


def _smooth_where_astray(outer: Floats, points: Floats, embedding: Embedding, target: Target) -> Floats:
    """Return the surface with moves from `points` filled in from around where it did not reach the target.

    Held back between sheets or caught in a crevice it is jagged there, for no reason of the target's.
    """
    astray = grown(target.tree.nearest(outer).distance > ASTRAY, embedding.means, AROUND)
    if not astray.any():
        return outer
    moves = outer - points
    for _ in range(FILLING):
        moves[astray] = embedding.means[astray] @ moves
    return stepped(outer, points + moves, embedding.means, embedding.faults_since(outer))


def _missed(points: Floats, triangles: Indices, target: Target) -> float:
    """Return the share of the target that is further than `ASTRAY` from the surface."""
    places = spread(target.tree.points, target.tree.triangles, count=PLACES)
    return float((SearchTree.of(points, triangles).nearest(places).distance > ASTRAY).mean())


def _steady_normals(points: Floats, embedding: Embedding) -> Floats:
    """Return normals averaged over two rings, so that single points do not turn aside."""
    normals = vertex_normals(points, embedding.triangles)
    for _ in range(2):
        normals = unit(embedding.means @ normals)
    return normals
