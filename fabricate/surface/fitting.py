"""Fitting: control points moved until the smooth surface lies on the surface that was remeshed.

A Catmull-Clark limit surface lies inside of its cage wherever that is convex, at an ear by more than a tile's side, so
a cage whose points lie on a scan makes a smooth surface that is too thin. Here its limit is drawn to the scan instead.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csr_array

from fabricate.arrays import Floats, Indices, Mask
from fabricate.duotone.catmull_clark import Subdivision, catmull_clark
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.errors import SolidError
from fabricate.surface.embedding import Embedding, Faulty, stored
from fabricate.surface.limit import limit_vertices
from fabricate.surface.smoothing import steadied
from fabricate.surface.stepping import stepped, untangled
from fabricate.surface.target import Target
from fabricate.triangles.adjacency import grown, neighbour_distances, neighbour_means
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.normals import vertex_normals

SCHEDULE = (4, 4, 3, 3, 2, 2, 1, 1, 1, 0, 0, 0)
"""How often the moves are smoothed in each round, over tile sides."""

REACH = 0.12
"""How far a point may move in a round, as a share of the bounding box's diagonal."""


def fitted(quads: QuadMesh, onto_points: Floats, onto_triangles: Indices) -> QuadMesh:
    """Return the quads with control points moved until the limit surface lies close to a closed surface; mm.

    Only where the limit surface would cross itself it stays away from the target. Where it does from the beginning, as
    that of coarse cells on a thin part that shrinks to nothing, it is drawn to the target first, which mostly cures it.

    Parameters
    ----------
    quads : QuadMesh
        In the place and of the shape of the target.
    onto_points, onto_triangles : (k, 3) float and (l, 3) int
        The target, mm, closed and outward.

    Raises
    ------
    SolidError
        If the limit surface of `quads` crosses itself already, and relaxing does not help; says if the target does.
    """
    target = Target.of(onto_points, onto_triangles)
    reach = REACH * float(np.linalg.norm(np.ptp(onto_points, axis=0)))
    shape = _LimitShape.of(quads)
    everywhere = np.ones(len(quads.points), dtype=bool)
    points = _drawn(quads, shape, target, reach=reach)
    if shape.crossed(points, everywhere).any():
        try:
            start = untangled(quads.points, _means(quads), shape.crossed)
        except SolidError as error:
            raise SolidError(f"{error}{_crossings(onto_points, onto_triangles)}") from None
        points = _drawn(replace(quads, points=start), shape, target, reach=reach)
    return replace(quads, points=points)


def _drawn(quads: QuadMesh, shape: _LimitShape, target: Target, *, reach: float) -> Floats:
    """Return control points whose limit surface is drawn to the target, but for where it crosses itself to the end."""
    fans, means = _fans(quads.tiles), _means(quads)
    points = stored(quads.points)
    tangled = shape.crossed(points, np.ones(len(points), dtype=bool))
    for passes in SCHEDULE:
        limit = limit_vertices(replace(quads, points=points))
        aims = target.aims(limit, vertex_normals(limit, fans), reach=reach)
        spacing = neighbour_distances(limit, fans)
        move = steadied(aims.place - limit, aims.weight, means, spacing, passes=passes)
        points = stepped(points, points + move, means, _but_for(tangled, shape.faults_since(points)))
        tangled &= shape.crossed(points, tangled)
    return points


def _crossings(points: Floats, triangles: Indices) -> str:
    """Return what has to be said if a target crosses itself, as no cells on it can be mended then, or nothing."""
    pairs = crossing_triangles(points, triangles)
    if not len(pairs):
        return ""
    x, y, z = points[triangles[pairs[0, 0]]].mean(axis=0)
    return (
        f"; the mesh crosses itself, too, {len(pairs)} pairs of its triangles do, one at ({x:.2f}, {y:.2f}, {z:.2f}) "
        'mm: prepare.repair = "wrap" puts a new skin round it'
    )


def _but_for(exempt: Mask, faulty: Faulty) -> Faulty:
    """Return the test without some points, (n,) bool."""
    return lambda points, moved: faulty(points, moved) & ~exempt


def _means(quads: QuadMesh) -> csr_array:
    return neighbour_means(_fans(quads.tiles), count=len(quads.points))


@dataclass(frozen=True, eq=False)
class _LimitShape:
    """The limit surface at the corners of a finer mesh, and what control points do to it."""

    finer: Subdivision
    embedding: Embedding

    @classmethod
    def of(cls, quads: QuadMesh) -> _LimitShape:
        finer = catmull_clark(quads)
        halves = finer.mesh.tiles[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)
        return cls(finer, Embedding.of(halves, count=len(finer.mesh.points)))

    def crossed(self, points: Floats, moved: Mask) -> Mask:
        """Return the control points, (n,) bool, of places where the limit surface crosses itself."""
        return self._control(self.embedding.crossed(self._limit(points), self._finer(moved)))

    def faults_since(self, old: Floats) -> Faulty:
        """Return the test for crossings, and for folds that the limit surface of the points `old` does not have."""
        faulty_limit = self.embedding.faults_since(self._limit(old))

        def faulty(points: Floats, moved: Mask) -> Mask:
            return self._control(faulty_limit(self._limit(points), self._finer(moved)))

        return faulty

    def _limit(self, points: Floats) -> Floats:
        return limit_vertices(replace(self.finer.mesh, points=self.finer.matrix @ points))

    def _finer(self, mask: Mask) -> Mask:
        """Return the points of the limit that depend on these control points, and a few more."""
        reached: Mask = self.finer.matrix @ mask.astype(np.float64) > 0.0
        return grown(reached, self.embedding.means, 2)

    def _control(self, mask: Mask) -> Mask:
        """Return the control points that finer points depend on."""
        found: Mask = self.finer.matrix.T @ mask.astype(np.float64) > 0.0
        return found


def _fans(tiles: Indices) -> Indices:
    """Return the triangle at every corner of every tile, (4 t, 3) int; no diagonal is favoured."""
    return tiles[:, [[0, 1, 2], [1, 2, 3], [2, 3, 0], [3, 0, 1]]].reshape(-1, 3)
