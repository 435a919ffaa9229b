"""Principal curvatures of the limit surface, tile by tile."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.tile_places import TilePlaces
from fabricate.triangles.normals import unit

ROUND = 0.15
"""Where the curvatures differ by a smaller share than this of the larger one, no direction is the most curved."""


class PrincipalCurvatures(NamedTuple):
    """The more strongly curved direction comes first.

    Attributes
    ----------
    values : (t, 2) float
        1/mm; positive where the surface bends away from its outward normal, as a ball does everywhere.
    directions : (t, 2, 3) float
        Unit tangent vectors; zero where both curvatures are alike, as on a ball.
    """

    values: Floats
    directions: Floats


def tile_curvatures(quads: QuadMesh) -> PrincipalCurvatures:
    """Return the principal curvatures in each tile.

    From the change of the points' normals along both diagonals of a tile, which is that of positions under the shape
    operator, made symmetric. Source: Rusinkiewicz, Estimating curvatures and their derivatives on triangle meshes,
    3DPVT 2004; here two diagonals of a quad take the place of three edges of a triangle, so nothing is left to fit.
    """
    places = TilePlaces.of(quads)
    normals = _point_normals(quads, places)
    yellow, blue = (places.corners[:, k + 2] - places.corners[:, k] for k in (0, 1))
    turned = [normals[quads.tiles[:, k + 2]] - normals[quads.tiles[:, k]] for k in (0, 1)]
    first = unit(yellow)
    second = np.cross(places.normal, first)
    a, b, d = _shape_operator(first, second, (yellow, blue), (turned[0], turned[1]))
    middle, half = (a + d) / 2.0, np.hypot((a - d) / 2.0, b)
    angle = 0.5 * np.arctan2(2.0 * b, a - d) + np.where(middle < 0.0, np.pi / 2.0, 0.0)
    strong = middle + np.where(middle < 0.0, -half, half)
    values = np.stack([strong, 2.0 * middle - strong], axis=1)
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    directions = np.stack([cos * first + sin * second, cos * second - sin * first], axis=1)
    alike = 2.0 * half <= ROUND * np.abs(strong)
    directions[alike] = 0.0
    return PrincipalCurvatures(values, directions)


def _shape_operator(
    first: Floats, second: Floats, diagonals: tuple[Floats, Floats], turned: tuple[Floats, Floats]
) -> tuple[Floats, Floats, Floats]:
    """Return the entries a, b, d of the matrices ((a, b), (b, d)) that turn diagonals into changes of the normal.

    In the frame of the unit vectors `first`, along the first diagonal, and `second`; each (t, 3). Tiles without area
    count as flat.
    """
    length, lean, height = _dot(diagonals[0], first), _dot(diagonals[1], first), _dot(diagonals[1], second)
    flat = (length <= 0.0) | (height <= 0.0)
    length, height = np.where(flat, np.inf, length), np.where(flat, np.inf, height)
    a, across = _dot(turned[0], first) / length, _dot(turned[0], second) / length
    other, d = (_dot(turned[1], first) - lean * a) / height, (_dot(turned[1], second) - lean * across) / height
    return a, (across + other) / 2.0, d


def _dot(left: Floats, right: Floats) -> Floats:
    products: Floats = np.einsum("tj,tj->t", left, right)
    return products


def _point_normals(quads: QuadMesh, places: TilePlaces) -> Floats:
    """Return the unit mean of the normals of the tiles at each point, (n, 3) float."""
    corners = quads.tiles.ravel()
    columns = [np.bincount(corners, np.repeat(axis, 4), minlength=len(quads.points)) for axis in places.normal.T]
    return unit(np.stack(columns, axis=1))
