"""What is wrong with an assembly, found exactly, and which surface points it comes from."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Indices, Mask
from fabricate.solid.assembly import Assembly
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.edge_pieces import EdgePieces, near_edges
from fabricate.triangles.nearby import triangles_near
from fabricate.triangles.search_tree import SearchTree

GAP_SHARE = 0.965
"""A gap found below this share of the clearance is a fault here."""

PROMISED_SHARE = 0.955
"""Below this share it is certain to be found; the promise to the user is 0.95."""


def crossing_points(assembly: Assembly, *, clearance: float, moved: Mask) -> Mask:
    """Return the surface points, (n,) bool, under triangles that cross; only near `moved` points, (n,) bool."""
    triangles: Indices = np.concatenate(assembly.bodies)
    if clearance == 0.0:  # the parts share their walls: look at each of those once
        triangles = triangles[np.unique(np.sort(triangles, axis=1), axis=0, return_index=True)[1]]
    triangles = triangles[_around(assembly, triangles, moved, reach=0.0)]
    pairs = crossing_triangles(assembly.points, triangles)
    return _surface_points(assembly, triangles[pairs].ravel())


def near_points(assembly: Assembly, *, clearance: float, moved: Mask) -> Mask:
    """Return the surface points, (n,) bool, under which the parts are nearer than the clearance allows.

    Only near `moved` points, (n,) bool. Each part is measured at its points and along its edges.
    """
    triangles = np.concatenate(assembly.bodies)
    around = _around(assembly, triangles, moved, reach=clearance)
    body = np.repeat(np.arange(len(assembly.bodies)), [len(each) for each in assembly.bodies])[around]
    least = GAP_SHARE * clearance
    near = [np.zeros(0, dtype=np.int64)]
    for number in range(len(assembly.bodies)):
        own, other = triangles[around[body == number]], triangles[around[body != number]]
        if not len(own) or not len(other):
            continue
        tree = SearchTree.of(assembly.points, other)
        numbers = np.unique(own)
        distance = np.full(len(assembly.points), np.inf)
        distance[numbers] = tree.nearest(assembly.points[numbers]).distance
        near.append(numbers[distance[numbers] < least])
        edges = own[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        edges = edges[edges[:, 0] < edges[:, 1]]
        pieces = EdgePieces.whole(assembly.points, edges, distance)
        found = near_edges(pieces, tree, reach=least, sure=PROMISED_SHARE * clearance)
        near.append(edges[found].ravel())
    return _surface_points(assembly, np.concatenate(near))


def _around(assembly: Assembly, triangles: Indices, moved: Mask, *, reach: float) -> Indices:
    """Return the numbers of the triangles within `reach` of those on moved surface points."""
    if moved.all():
        return np.arange(len(triangles))
    everywhere = np.tile(moved, len(assembly.points) // assembly.surface_points)
    return triangles_near(assembly.points, triangles, everywhere, reach=reach)


def _surface_points(assembly: Assembly, numbers: Indices) -> Mask:
    points: Mask = np.zeros(assembly.surface_points, dtype=bool)
    points[numbers % assembly.surface_points] = True
    return points
