"""Points and normals on the exact Catmull-Clark limit surface of a quad mesh.

One more Catmull-Clark step splits every tile into four quarters with at most one extraordinary corner, the tile's
own, from which also all creases start that come near; each quarter is a patch (see `patch`). Evaluation is linear in
the control points and kept as such: a `LimitOperator` is a block-sparse matrix that can be applied to positions,
colours or any other attribute.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.duotone.catmull_clark import catmull_clark
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.patch import PatchBasis, corner_position, patch_basis
from fabricate.triangles.normals import unit


class Samples(NamedTuple):
    """The same parameters on each of several tiles.

    tiles : (t,) int; uv : (s, 2) float in the tile's square (0, 0) = corner 0, (1, 0) = corner 1;
    rows : (t, s) int, where each result belongs. A row may be named by several tiles that share the point.
    """

    tiles: Indices
    uv: Floats
    rows: Indices


class _Block(NamedTuple):
    rows: Indices
    control: Indices
    basis: PatchBasis


@dataclass(frozen=True, eq=False)
class LimitOperator:
    """The linear map from control points to limit positions and derivatives at chosen samples."""

    blocks: tuple[_Block, ...]
    size: int

    def positions(self, control: Floats) -> Floats:
        """Return limit values of values at the refined mesh's points, (m, d), as (size, d) float."""
        return self._applied(control, 0)

    def normals(self, control: Floats) -> Floats:
        """Return unit outward normals of the limit surface, (size, 3) float; on a crease, of a tile that was asked."""
        return unit(np.cross(self._applied(control, 1), self._applied(control, 2)))

    def _applied(self, control: Floats, member: int) -> Floats:
        values = np.zeros((self.size, control.shape[1]))
        for block in self.blocks:
            gathered = control[block.control].transpose(1, 0, 2).reshape(block.control.shape[1], -1)
            result = (block.basis[member] @ gathered).reshape(len(block.basis[member]), len(block.rows), -1)
            values[block.rows] = result.transpose(1, 0, 2)
        return values


@dataclass(frozen=True, eq=False)
class LimitSurface:
    """A quad mesh made ready for evaluation: its refinement and the patches' control points.

    Attributes
    ----------
    control : (m, 3) float
        Points of the refined mesh.
    valence : (4 t,) int
        Valence of the extraordinary corner of each quarter.
    """

    refined: QuadMesh
    valence: Indices

    @classmethod
    def of(cls, quads: QuadMesh) -> LimitSurface:
        """Refine `quads` once."""
        refined = catmull_clark(quads).mesh
        counts = np.bincount(refined.tiles.ravel(), minlength=len(refined.points))
        return cls(refined, counts[refined.tiles[:, 0]])

    @property
    def control(self) -> Floats:
        """(m, 3) float: the control points to which operators apply, mm."""
        return self.refined.points

    def operator(self, samples: list[Samples], *, size: int) -> LimitOperator:
        """Return the operator that evaluates all samples into `size` rows."""
        blocks: list[_Block] = []
        for tiles, uv, rows in samples:
            quarter_of_sample = _quarter(uv)
            for quarter in range(4):
                here = np.flatnonzero(quarter_of_sample == quarter)
                if len(here):
                    blocks += self._blocks(4 * tiles + quarter, _local(uv[here], quarter), rows[:, here])
        return LimitOperator(tuple(blocks), size)

    def _blocks(self, quarters: Indices, local: Floats, rows: Indices) -> list[_Block]:
        valence = self.valence[quarters]
        blocks = []
        for n in np.unique(valence):
            group = np.flatnonzero(valence == n)
            spokes = _spokes(self.refined, 4 * quarters[group], int(n))
            control = _control_points(self.refined, quarters[group], spokes)
            for creases, same in _alike(self.refined.creases[spokes]):
                basis = patch_basis(local, valence=int(n), creases=creases)
                blocks.append(_Block(rows[group[same]], control[same], basis))
        return blocks


def limit_vertices(quads: QuadMesh) -> Floats:
    """Return the limit position of every vertex, (n, 3) float, mm.

    Mask: (N^2 v + 4 sum of neighbours + sum of diagonal points) / (N (N + 5)). On a crease (e + 4 v + e') / 6 with its
    two neighbours there; a corner stays.
    """
    total = np.zeros_like(quads.points)
    n = np.bincount(quads.tiles.ravel(), minlength=len(quads.points))[:, None]
    for k in range(4):
        neighbour, diagonal = quads.tiles[:, (k + 1) % 4], quads.tiles[:, (k + 2) % 4]
        values = 4.0 * quads.points[neighbour] + quads.points[diagonal]
        for axis in range(3):
            total[:, axis] += np.bincount(quads.tiles[:, k], values[:, axis], minlength=len(total))
    limit: Floats = (n * n * quads.points + total) / (n * (n + 5.0))
    if quads.creases.any():
        _put_on_creases(limit, quads)
    return limit


def _put_on_creases(limit: Floats, quads: QuadMesh) -> None:
    """Replace the limit positions of corners, points on creases, and darts."""
    tail = quads.tiles.ravel()
    sharp = np.flatnonzero(quads.creases)
    first = sharp[np.unique(tail[sharp], return_index=True)[1]]
    valence = np.bincount(tail, minlength=len(limit))[tail[first]]
    for n in np.unique(valence):
        spokes = _spokes(quads, first[valence == n], int(n))
        for creases, same in _alike(quads.creases[spokes]):
            ring = _ring(quads, spokes[same])
            limit[ring[:, 0]] = np.einsum("k,pkj->pj", corner_position(creases), quads.points[ring])


def _alike(spokes: Mask) -> list[tuple[tuple[bool, ...], Indices]]:
    """Return each different row of creases, (q, N) bool, with the numbers of the rows that are like it."""
    if not spokes.any():
        return [((False,) * spokes.shape[1], np.arange(len(spokes)))]
    kinds, kind = np.unique(spokes, axis=0, return_inverse=True)
    return [(tuple(row), np.flatnonzero(kind == k)) for k, row in enumerate(kinds.tolist())]


def _quarter(uv: Floats) -> Indices:
    """Return which corner's quarter holds each sample: 0 to 3, counter-clockwise from (0, 0)."""
    right, upper = uv[:, 0] > 0.5, uv[:, 1] > 0.5
    return np.where(upper, np.where(right, 2, 3), np.where(right, 1, 0))


def _local(uv: Floats, quarter: int) -> Floats:
    """Return the parameters within a quarter, measured from the tile's corner along its two sides."""
    u, v = uv.T
    turned = ((u, v), (v, 1.0 - u), (1.0 - u, 1.0 - v), (1.0 - v, u))[quarter]
    return 2.0 * np.stack(turned, axis=1)


def _following(h: Indices) -> Indices:
    return 4 * (h // 4) + (h + 1) % 4


def _preceding(h: Indices) -> Indices:
    return 4 * (h // 4) + (h - 1) % 4


def _spokes(mesh: QuadMesh, first: Indices, valence: int) -> Indices:
    """Return the half-edges that leave the same point of valence N, counter-clockwise, (q, N) int."""
    spokes = [first]
    for _ in range(valence - 1):
        spokes.append(mesh.twins[_preceding(spokes[-1])])
    return np.stack(spokes, axis=1)


def _ring(mesh: QuadMesh, spokes: Indices) -> Indices:
    """Return the point that spokes leave and its ring of ends and diagonal points in turn, (q, 2 N + 1) int."""
    tail, ends = mesh.tiles.ravel(), _following(spokes)
    ring = np.stack([tail[ends], tail[_following(ends)]], axis=2).reshape(len(spokes), -1)
    return np.concatenate([tail[spokes[:, :1]], ring], axis=1)


def _control_points(mesh: QuadMesh, quads: Indices, spokes: Indices) -> Indices:
    """Return the 2 N + 8 control points of patches with these spokes at corner 0, (q, 2 N + 8) int."""
    tail, twin = mesh.tiles.ravel(), mesh.twins
    right, top = twin[4 * quads + 1], twin[4 * quads + 2]
    lower_right = twin[_following(right)]
    upper_right = twin[_preceding(right)]
    upper_left = twin[_preceding(top)]
    far = [
        tail[_preceding(lower_right)],
        tail[_following(_following(right))],
        tail[_preceding(right)],
        tail[_following(_following(upper_right))],
        tail[_following(_following(top))],
        tail[_preceding(top)],
        tail[_following(_following(upper_left))],
    ]
    return np.concatenate([_ring(mesh, spokes), np.stack(far, axis=1)], axis=1)
