r"""Basis functions of a Catmull-Clark patch with one extraordinary corner, on its 2 N + 8 control points.

The patch is the quad with corners (0, 0), (1, 0), (1, 1), (0, 1); its corner (0, 0) has valence N, the other three
are regular. Control points are numbered: 0 the corner itself; then its ring e0, f0, e1, f1, ... counter-clockwise,
with the patch between e0 and e1; then seven points round the far side:

    (-1,2)   (0,2)   (1,2)   (2,2)        e0 = (1, 0)    f0 = (1, 1)   e1 = (0, 1)
     +--------+-------+-------+           f1 = (-1, 1)   e2 = (-1, 0)
     |        |       |       |           e[N-1] = (0, -1)
    f1 ------ e1 ---- f0 --- (2,1)        f[N-1] = (1, -1)
     |        | patch |       |
    e2 ------ 0 ----- e0 --- (2,0)        A regular corner (N = 4) has f2 = (-1, -1), and the
              |       |       |           16 points are those of a bicubic B-spline.
            e[N-1]- f[N-1]--(2,-1)

Source: the invariant neighbourhood and its subdivision matrix follow Stam, SIGGRAPH 1998; powers of the matrix are
multiplied out instead of diagonalised, as a tile's samples lie only a few subdivisions from the corner. Limit masks
at the corner: Halstead, Kass and DeRose, SIGGRAPH 1993.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices, Mask

FAR_POINTS = ((2, -1), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (-1, 2))
"""The seven far points in the order of their numbers 2 N + 1 to 2 N + 7."""


class PatchBasis(NamedTuple):
    """Weights of the control points for position and both derivatives, each (s, 2 N + 8) float.

    The derivatives span the tangent plane with the right orientation. Away from the extraordinary corner they
    are true to direction, scaled by a positive factor per sample; at the corner they are two tangents.
    """

    position: Floats
    along_u: Floats
    along_v: Floats


def patch_basis(uv: Floats, *, valence: int) -> PatchBasis:
    """Return the basis functions at parameters `uv`, (s, 2) float in [0, 1]."""
    count = 2 * valence + 8
    if valence == 4:
        return _bicubic(uv, _grid_numbers(4, (0, 0)), count)
    basis = PatchBasis(*(np.zeros((len(uv), count)) for _ in range(3)))
    corner = uv.max(axis=1) == 0.0
    for target, mask in zip(basis, _corner_masks(valence), strict=True):
        target[corner] = mask
    step, fine_step = _subdivision(valence)
    local, power, left = uv.copy(), np.eye(count), ~corner
    while left.any():
        local = local * 2.0
        now = left & (local.max(axis=1) > 1.0)
        _evaluate_split(basis, local, now, fine_step @ power, valence)
        power, left = step @ power, left & ~now
    return basis


def _evaluate_split(basis: PatchBasis, local: Floats, now: Mask, control: Floats, valence: int) -> None:
    """Fill in samples that lie in one of the three regular quarters of the subdivided patch."""
    for quarter in ((1, 0), (1, 1), (0, 1)):
        here = now & ((local > 1.0) == np.array(quarter, dtype=bool)).all(axis=1)
        fine = _bicubic(local[here] - quarter, _grid_numbers(valence, quarter), 2 * valence + 17)
        for target, weights in zip(basis, fine, strict=True):
            target[here] = weights @ control


def _number(valence: int, point: tuple[int, int]) -> int:
    """Return the number of the control point at grid position (i, j); fine far points follow from 2 N + 1."""
    ring = {
        (0, 0): 0,
        (1, 0): 1,
        (1, 1): 2,
        (0, 1): 3,
        (-1, 1): 4,
        (-1, 0): 1 + 4 % (2 * valence),
        (0, -1): 2 * valence - 1,
        (1, -1): 2 * valence,
    }
    if valence == 4:
        ring[(-1, -1)] = 6
    return ring[point] if point in ring else 2 * valence + 1 + _FINE_FAR.index(point)


# the far points of the subdivided neighbourhood, in the order that keeps the coarse seven first
_FINE_FAR = (
    *FAR_POINTS,
    *((3, j) for j in range(-1, 4)),
    *((i, 3) for i in range(2, -2, -1)),
)


def _grid_numbers(valence: int, quarter: tuple[int, int]) -> Indices:
    """Return the numbers of the 16 points round a regular quarter, rows j, columns i, (16,) int."""
    a, b = quarter
    return np.array([_number(valence, (a + i, b + j)) for j in range(-1, 3) for i in range(-1, 3)])


def _bicubic(uv: Floats, numbers: Indices, count: int) -> PatchBasis:
    """Return uniform bicubic B-spline weights spread over `count` control points."""
    bu, bv = _cubic(uv[:, 0]), _cubic(uv[:, 1])
    du, dv = _cubic_slope(uv[:, 0]), _cubic_slope(uv[:, 1])
    # a sum, not an assignment: round a corner of valence 2 a point stands in two places of the grid
    spread = np.eye(count)[numbers]
    products = ((bu, bv), (du, bv), (bu, dv))
    return PatchBasis(*((v[:, :, None] * u[:, None, :]).reshape(-1, 16) @ spread for u, v in products))


def _cubic(t: Floats) -> Floats:
    """Return the four uniform cubic B-spline weights at t, (s, 4)."""
    s = 1.0 - t
    return np.stack([s**3, 3 * t**3 - 6 * t**2 + 4, 3 * s**3 - 6 * s**2 + 4, t**3], axis=1) / 6.0


def _cubic_slope(t: Floats) -> Floats:
    s = 1.0 - t
    return np.stack([-(s**2), 3 * t**2 - 4 * t, -3 * s**2 + 4 * s, t**2], axis=1) / 2.0


def _corner_masks(valence: int) -> tuple[Floats, Floats, Floats]:
    """Return the weights of limit position and tangents at the extraordinary corner, each (2 N + 8,)."""
    n = valence
    position, along_u = np.zeros(2 * n + 8), np.zeros(2 * n + 8)
    along_v = np.zeros(2 * n + 8)
    edges, faces = np.arange(1, 2 * n, 2), np.arange(2, 2 * n + 1, 2)
    position[0] = n * n
    position[edges], position[faces] = 4.0, 1.0
    angle = 2.0 * np.pi * np.arange(n + 1) / n
    edge_weight = 1.0 + np.cos(2 * np.pi / n) + np.cos(np.pi / n) * np.sqrt(2 * (9 + np.cos(2 * np.pi / n)))
    for mask, wave in ((along_u, np.cos(angle)), (along_v, np.sin(angle))):
        mask[edges] = edge_weight * wave[:n]
        mask[faces] = wave[:n] + wave[1:]
    if n == 2:  # both waves run along the edges there; the other tangent joins the two faces
        along_v[faces] = 1.0, -1.0
    return position / (n * (n + 5)), along_u, along_v


def _subdivision(valence: int) -> tuple[Floats, Floats]:
    """Return Stam's matrices: (2 N + 8, 2 N + 8) to the same points one step finer, (2 N + 17, 2 N + 8) to all."""
    n = valence
    fine = np.zeros((2 * n + 17, 2 * n + 8))
    around = np.arange(n)
    edge, face = 1 + 2 * around, 2 + 2 * around
    next_edge, last_edge = 1 + 2 * ((around + 1) % n), 1 + 2 * ((around - 1) % n)
    last_face = 2 + 2 * ((around - 1) % n)
    fine[0, 0] = 1.0 - 7.0 / (4.0 * n)
    corner = np.zeros(n, dtype=np.int64)
    fine[0, edge] += 1.5 / n**2
    fine[0, face] += 0.25 / n**2
    for columns, sixteenths in ((corner, 6), (edge, 6), (next_edge, 1), (last_edge, 1), (face, 1), (last_face, 1)):
        fine[edge, columns] += sixteenths / 16.0
    for columns in (corner, edge, face, next_edge):
        fine[face, columns] += 0.25
    for row, point in enumerate(_FINE_FAR, start=2 * n + 1):
        for column, weight in _regular_rule(n, point):
            fine[row, column] += weight
    return fine[: 2 * n + 8], fine


def _regular_rule(valence: int, point: tuple[int, int]) -> list[tuple[int, float]]:
    """Return the coarse points and weights that make a fine point in the regular part of the grid."""
    along = [_knot_rule(coordinate) for coordinate in point]
    return [(_number(valence, (i, j)), wi * wj) for i, wi in along[0] for j, wj in along[1]]


def _knot_rule(coordinate: int) -> list[tuple[int, float]]:
    """Cubic B-spline knot insertion: 1/8 3/4 1/8 at old knots, 1/2 1/2 between them."""
    half = coordinate // 2
    if coordinate % 2 == 0:
        return [(half - 1, 0.125), (half, 0.75), (half + 1, 0.125)]
    return [(half, 0.5), (half + 1, 0.5)]
