"""Mitres: which way is down at a crease, and how far, so that a wall is as thick as asked on every side of it.

At a point p of a crease the surface has a normal n on each side. Walking from there by the depth times -m, where
m . n = 1 for all of them, ends at q, as deep under each side, where the inner sides meet in an edge of their own:

    ---------------- p
                   / |      The direction of m is taken for the normal of the point, and its length is the mitre:
    ------------ q   |      at a right angle m = n1 + n2, and the mitre is the square root of 2.
                 |   |

Beside the crease the way down leans too, less and less, as there is less room on the inner side of a convex edge than
on the outer one, and more of it on that of a concave one.
"""

from __future__ import annotations

from typing import NamedTuple

import igl
import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array

from fabricate.arrays import Floats, Indices, Mask
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.conjugate_gradients import solved
from fabricate.surface.limit import LimitSurface, Samples
from fabricate.surface.template import TileTemplate
from fabricate.triangles.normals import unit

MOST = 4.0
"""Largest mitre: an edge or a corner so sharp that it would need more, of less than 29 degrees, gets a thinner wall;
one of less than about 1 degree, the normal of one of its sides."""

INDEPENDENT = 1e-4
"""Squared share of a direction in the normals below which they say nothing about it: sides that differ by less than
1.1 degrees are one, and the tiles along one side of a curved crease do not make it a corner."""

JUST_INSIDE = 0.01
"""Where a tile's side at its corner is looked at, in its square: at the corner itself it may have no normal."""

GENTLE = 4.0
"""Over how many times its own length a step aside fades, so that the inner surface keeps most of its room."""

STIFF = 10.0
"""Stiffness of creases, in that of a strip of face as wide as steps reach: steps fade along creases first, and from
there into the faces. From a corner straight into faces they would fade the faster the nearer to it, and fold."""

ALIGNED = 0.9
"""Cosine from which an edge between two points of creases lies on one."""


class CreaseSides(NamedTuple):
    """Normals of the tiles that meet at points on creases: points (k,) int, normals (k, 3) float."""

    points: Indices
    normals: Floats


class Mitred(NamedTuple):
    """How the ways down begin at each point.

    normals : (n, 3) float, unit; mitre : (n,) float >= 1; along : (n, 3) float, the unit tangent of the crease, and
    zero at corners, which have none, and off creases.
    """

    normals: Floats
    mitre: Floats
    along: Floats


def crease_sides(quads: QuadMesh, limit: LimitSurface, template: TileTemplate, table: Indices) -> CreaseSides:
    """Return the one-sided normals at all points of creases.

    `table`, (t, s) int, holds the point number of each of the template's samples on each tile.
    """
    creased = quads.creases.reshape(-1, 4)
    corners = quads.crease_counts[quads.tiles] >= 2
    per_side = template.rays.shape[2] - 2
    wanted = np.concatenate([corners, np.repeat(creased, per_side, axis=1)], axis=1)
    tiles = np.flatnonzero(wanted.any(axis=1))
    uv = template.uv[: wanted.shape[1]].copy()
    uv[:4] += JUST_INSIDE * (1.0 - 2.0 * uv[:4])
    rows = np.arange(len(tiles) * len(uv)).reshape(len(tiles), len(uv))
    normals = limit.operator([Samples(tiles, uv, rows)], size=rows.size).normals(limit.control)
    here = wanted[tiles]
    return CreaseSides(table[tiles, : len(uv)][here], normals[rows[here]])


def mitred_normals(normals: Floats, sides: CreaseSides) -> Mitred:
    """Return the normals, (n, 3), with those at points of creases replaced, with mitres and tangents.

    Where more than three sides meet there may be no common mitre: then it is as long as the side that needs most.
    """
    numbers, place = np.unique(sides.points, return_inverse=True)
    products = np.einsum("ki,kj->kij", sides.normals, sides.normals).reshape(-1, 9)
    values, vectors = np.linalg.eigh(_summed(products, place, len(numbers)).reshape(-1, 3, 3))
    spanned = values > INDEPENDENT * values[:, 2:]
    shares = np.einsum("pij,pi->pj", vectors, _summed(sides.normals, place, len(numbers)))
    shares = np.where(spanned, shares / np.where(spanned, values, 1.0), 0.0)
    way = unit(np.einsum("pij,pj->pi", vectors, shares))
    steepest = np.ones(len(numbers))
    np.minimum.at(steepest, place, np.einsum("ki,ki->k", sides.normals, way[place]))
    sharp = spanned[:, 1]
    mitred = Mitred(normals.copy(), np.ones(len(normals)), np.zeros_like(normals))
    mitred.normals[numbers[sharp]] = way[sharp]
    mitred.mitre[numbers[sharp]] = 1.0 / np.maximum(steepest[sharp], 1.0 / MOST)
    edge = sharp & ~spanned[:, 0]
    mitred.along[numbers[edge]] = vectors[edge, :, 0]
    return mitred


def _summed(values: Floats, place: Indices, count: int) -> Floats:
    return np.stack([np.bincount(place, column, minlength=count) for column in values.T], axis=1)


def ways_out(points: Floats, triangles: Indices, mitred: Mitred, *, depth: float) -> Floats:
    """Return for each point the vector by which it moves out when a wall grows by a mm, (n, 3) float.

    At corners it is the mitre along the normal; on creases the same and a step along the crease; elsewhere the
    normal and a step aside. Such steps keep the depth, and make room for a wall of `depth` mm: they fade away
    from corners and creases as the solution of a screened Laplace equation on the surface does.
    """
    ways = mitred.mitre[:, None] * mitred.normals
    on_crease = mitred.mitre > 1.0
    if not on_crease.any():
        return ways
    reach = GENTLE * depth * float(np.sqrt(np.square(mitred.mitre).max() - 1.0))
    stiffness = csr_array(igl.cotmatrix(points, triangles))
    areas = csr_array(igl.massmatrix(points, triangles, igl.MASSMATRIX_TYPE_BARYCENTRIC)).diagonal()
    energy = (
        diags_array(areas / reach**2) - stiffness + STIFF * reach * _along_creases(points, triangles, mitred, reach)
    )
    spread = _spread(csr_array(energy), ways, on_crease, mitred.along)
    aside = spread - np.einsum("ij,ij->i", spread, mitred.normals)[:, None] * mitred.normals
    return np.where(on_crease[:, None], spread, ways + aside)


def _along_creases(points: Floats, triangles: Indices, mitred: Mitred, reach: float) -> csr_array:
    """Return the matrix of the screened Laplace equation on the creases alone, (n, n)."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges = edges[(mitred.mitre[edges] > 1.0).all(axis=1)]  # once in each direction
    way = points[edges[:, 1]] - points[edges[:, 0]]
    length = np.linalg.norm(way, axis=1)
    cosines = np.abs(np.einsum("ij,ikj->ik", way, mitred.along[edges])).max(axis=1)
    on = cosines > ALIGNED * length
    (first, second), length = edges[on].T, length[on]
    rows, columns = np.concatenate([first, first]), np.concatenate([first, second])
    values = np.concatenate([1.0 / length + 0.5 * length / reach**2, -1.0 / length])
    return coo_array((values, (rows, columns)), shape=(len(points), len(points))).tocsr()


def _spread(operator: csr_array, ways: Floats, on_crease: Mask, along: Floats) -> Floats:
    """Return the field, (n, 3), of least energy that keeps `ways` on creases but for what is `along` them."""

    def free(values: Floats) -> Floats:
        return np.where(on_crease[:, None], np.einsum("ij,ij->i", values, along)[:, None] * along, values)

    start = np.where(on_crease[:, None], ways, 0.0)
    return solved(operator, np.zeros_like(start), start, free=free)
