"""Points and normals on the exact Catmull-Clark limit surface of a quad mesh.

One more Catmull-Clark step splits every tile into four quarters with at most one extraordinary corner, the tile's
own; each quarter is a patch (see `patch`). Evaluation is linear in the control points and kept as such: a
`LimitOperator` is a block-sparse matrix that can be applied to positions, colours or any other attribute.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.duotone.catmull_clark import catmull_clark
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.patch import PatchBasis, patch_basis
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
        """Return unit outward normals of the limit surface, (size, 3) float."""
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
            control = _control_points(self.refined, quarters[group], int(n))
            blocks.append(_Block(rows[group], control, patch_basis(local, valence=int(n))))
        return blocks


def limit_vertices(quads: QuadMesh) -> Floats:
    """Return the limit position of every vertex, (n, 3) float, mm.

    Mask: (N^2 v + 4 sum of neighbours + sum of diagonal points) / (N (N + 5)).
    """
    total = np.zeros_like(quads.points)
    n = np.bincount(quads.tiles.ravel(), minlength=len(quads.points))[:, None]
    for k in range(4):
        neighbour, diagonal = quads.tiles[:, (k + 1) % 4], quads.tiles[:, (k + 2) % 4]
        values = 4.0 * quads.points[neighbour] + quads.points[diagonal]
        for axis in range(3):
            total[:, axis] += np.bincount(quads.tiles[:, k], values[:, axis], minlength=len(total))
    limit: Floats = (n * n * quads.points + total) / (n * (n + 5.0))
    return limit


def _quarter(uv: Floats) -> Indices:
    """Return which corner's quarter holds each sample: 0 to 3, counter-clockwise from (0, 0)."""
    right, upper = uv[:, 0] > 0.5, uv[:, 1] > 0.5
    return np.where(upper, np.where(right, 2, 3), np.where(right, 1, 0))


def _local(uv: Floats, quarter: int) -> Floats:
    """Return the parameters within a quarter, measured from the tile's corner along its two sides."""
    u, v = uv.T
    turned = ((u, v), (v, 1.0 - u), (1.0 - u, 1.0 - v), (1.0 - v, u))[quarter]
    return 2.0 * np.stack(turned, axis=1)


def _control_points(mesh: QuadMesh, quads: Indices, valence: int) -> Indices:
    """Return the 2 N + 8 control points of patches whose corner 0 has valence N, (q, 2 N + 8) int."""
    tail, twin = mesh.tiles.ravel(), mesh.twins

    def following(h: Indices) -> Indices:
        return 4 * (h // 4) + (h + 1) % 4

    def preceding(h: Indices) -> Indices:
        return 4 * (h // 4) + (h - 1) % 4

    columns = [tail[4 * quads]]
    spoke = 4 * quads
    for _ in range(valence):
        columns += [tail[following(spoke)], tail[following(following(spoke))]]
        spoke = twin[preceding(spoke)]
    right, top = twin[4 * quads + 1], twin[4 * quads + 2]
    lower_right = twin[following(right)]
    upper_right = twin[preceding(right)]
    upper_left = twin[preceding(top)]
    columns += [
        tail[preceding(lower_right)],
        tail[following(following(right))],
        tail[preceding(right)],
        tail[following(following(upper_right))],
        tail[following(following(top))],
        tail[preceding(top)],
        tail[following(following(upper_left))],
    ]
    return np.stack(columns, axis=1)
