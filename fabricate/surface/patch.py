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

Any of the spokes from 0 to e0, e1, ... may be a crease; it then goes on in a straight count of points beyond its e, and
no other crease comes near. Beside a crease the surface is that of the points on its own side alone: a bicubic
B-spline whose points across are the mirror images, twice the crease's minus the inner ones, of those on this side.

Source: the invariant neighbourhood and its subdivision matrix follow Stam, SIGGRAPH 1998; powers of the matrix are
multiplied out instead of diagonalised, as a tile's samples lie only a few subdivisions from the corner. Limit masks
at the corner: Halstead, Kass and DeRose, SIGGRAPH 1993. Crease rules: DeRose, Kass and Truong, SIGGRAPH 1998; their
limits at the corner of a patch come from powers of the matrix, as its eigenvalues depend on every sector's size.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Mask

SETTLED = 200
"""Steps to the tangents at a creased corner. Most stand still long before; those of a single tile beside a crease,
or of two tiles between creases at a corner, go on turning in step n by about 1 / n of what is left."""

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


def patch_basis(uv: Floats, *, valence: int, creases: tuple[bool, ...] = ()) -> PatchBasis:
    """Return the basis functions at parameters `uv`, (s, 2) float in [0, 1].

    `creases` says of each of the N spokes whether it is a crease; by default none is. On a crease derivatives are
    those of the patch's own side.
    """
    count = 2 * valence + 8
    creases = creases if any(creases) else (False,) * valence
    if valence == 4 and not any(creases):
        return _bicubic(uv, _spread(4, (0, 0), creases, count))
    basis = PatchBasis(*(np.zeros((len(uv), count)) for _ in range(3)))
    corner = uv.max(axis=1) == 0.0
    step, fine_step = _subdivision(valence, creases)
    masks = _creased_corner_masks(step, fine_step, creases) if any(creases) else _corner_masks(valence)
    for target, mask in zip(basis, masks, strict=True):
        target[corner] = mask
    local, power, left = uv.copy(), np.eye(count), ~corner
    while left.any():
        local = local * 2.0
        now = left & (local.max(axis=1) > 1.0)
        _evaluate_split(basis, local, now, fine_step @ power, creases)
        power, left = step @ power, left & ~now
    return basis


def corner_position(creases: tuple[bool, ...]) -> Floats:
    """Return the weights of the corner and its ring, (2 N + 1,) float, in the corner's limit position.

    `creases` says of each of the N spokes whether it is a crease; at least one is.
    """
    n = len(creases)
    mask = np.zeros(2 * n + 1)
    if sum(creases) > 2:
        mask[0] = 1.0
    elif sum(creases) == 2:
        mask[0], mask[1::2] = 2.0 / 3.0, np.array(creases) / 6.0
    else:  # a dart: the mean that subdivision does not change
        step = _subdivision(n, creases)[0][: 2 * n + 1, : 2 * n + 1]
        stays = np.concatenate([step.T - np.eye(2 * n + 1), np.ones((1, 2 * n + 1))])
        mask = np.linalg.lstsq(stays, np.eye(2 * n + 2)[-1], rcond=None)[0]
    return mask


def _evaluate_split(basis: PatchBasis, local: Floats, now: Mask, control: Floats, creases: tuple[bool, ...]) -> None:
    """Fill in samples that lie in one of the three regular quarters of the subdivided patch."""
    valence = len(creases)
    for quarter in ((1, 0), (1, 1), (0, 1)):
        here = now & ((local > 1.0) == np.array(quarter, dtype=bool)).all(axis=1)
        fine = _bicubic(local[here] - quarter, _spread(valence, quarter, creases, 2 * valence + 17))
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


def _spread(valence: int, quarter: tuple[int, int], creases: tuple[bool, ...], count: int) -> Floats:
    """Return the 16 points round a regular quarter, rows j, as means of `count` control points, (16, count)."""
    a, b = quarter
    grid = [[_number(valence, (a + i, b + j)) for i in range(-1, 3)] for j in range(-1, 3)]
    spread = np.eye(count)[grid]
    if quarter == (1, 0) and creases[0]:
        spread[0] = 2.0 * spread[1] - spread[2]
    if quarter == (0, 1) and creases[1]:
        spread[:, 0] = 2.0 * spread[:, 1] - spread[:, 2]
    return spread.reshape(16, count)


def _bicubic(uv: Floats, spread: Floats) -> PatchBasis:
    """Return uniform bicubic B-spline weights of 16 points, spread over the control points that make them."""
    bu, bv = _cubic(uv[:, 0]), _cubic(uv[:, 1])
    du, dv = _cubic_slope(uv[:, 0]), _cubic_slope(uv[:, 1])
    # a product, not an assignment: round a corner of valence 2 a point stands in two places of the grid
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


def _creased_corner_masks(step: Floats, fine_step: Floats, creases: tuple[bool, ...]) -> tuple[Floats, Floats, Floats]:
    """Return the weights of limit position and tangents at a corner with creases, each (2 N + 8,).

    The tangents are those that derivatives at the middle of the patch turn into when it shrinks towards the corner.
    They are made orthonormal, as weights, after each step: then the plane they span and its orientation survive
    where one of them outgrows the other.
    """
    ring = 2 * len(creases) + 1
    position = np.zeros(len(step))
    position[:ring] = corner_position(creases)
    slopes = _bicubic(np.full((1, 2), 0.5), _spread(len(creases), (1, 1), creases, len(fine_step)))
    tangents = np.concatenate(slopes[1:]) @ fine_step
    for _ in range(SETTLED):
        tangents = tangents @ step
        tangents -= tangents.sum(axis=1, keepdims=True) * position
        turned, length = np.linalg.qr(tangents.T)
        tangents = turned.T * np.sign(np.diag(length))[:, None]
    return position, tangents[0], tangents[1]


def _subdivision(valence: int, creases: tuple[bool, ...]) -> tuple[Floats, Floats]:
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
    if any(creases):
        _sharpen(fine, creases)
    return fine[: 2 * n + 8], fine


def _sharpen(fine: Floats, creases: tuple[bool, ...]) -> None:
    """Replace the rules of the points on creases: the corner, ends of spokes, and points beyond e0 and e1."""
    n = len(creases)
    spokes = 1 + 2 * np.flatnonzero(creases)
    fine[spokes] = 0.0
    fine[spokes, 0] = fine[spokes, spokes] = 0.5
    if len(spokes) >= 2:
        fine[0] = 0.0
        fine[0, 0] = 1.0
    if len(spokes) == 2:
        fine[0, 0], fine[0, spokes] = 0.75, 0.125
    for spoke, (i, j) in ((0, (1, 0)), (1, (0, 1))):
        for steps in (2, 3) if creases[spoke] else ():
            row = _number(n, (steps * i, steps * j))
            fine[row] = 0.0
            for along, weight in _knot_rule(steps):
                fine[row, _number(n, (along * i, along * j))] += weight


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
