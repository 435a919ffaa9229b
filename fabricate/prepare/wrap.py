"""Alpha wrap: a closed surface round triangles in any state."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.errors import MeshError
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.mesh_lab import mesh_lab, silenced
from fabricate.prepare.unit_box import UnitBox
from fabricate.triangles.normals import area_vectors


def wrapped(points: Floats, triangles: Indices, *, alpha: float, offset: float) -> PolygonMesh:
    """Return a closed, orientable 2-manifold that does not cross itself and lies round all triangles.

    Triangles may be open, crossing, wound anyhow, without area, or have corners that are not finite; only those
    with area count. They are wrapped in a box of diagonal 1 and scaled back, so their size is of no concern.
    Bodies further apart than `alpha` give several components. The same triangles give the same wrap.

    Parameters
    ----------
    points : (n, 3) float
        In any unit.
    triangles : (t, 3) int
        On the points.
    alpha : float
        Diameter of the smallest gap that the wrap goes into, as a share of the diagonal of the bounding box.
    offset : float
        Distance of the wrap from the triangles, outside, as a share of the same diagonal.

    Raises
    ------
    MeshError
        If no triangle has area.
    PrepareError
        If PyMeshLab or libraries that it needs are missing.

    References
    ----------
    .. [1] C. Portaneri, M. Rouxel-Labbe, M. Hemmer, D. Cohen-Steiner, P. Alliez, "Alpha wrapping with an
           offset", ACM Transactions on Graphics 41(4), 2022; the implementation is CGAL's.
    """
    triangles = finite_triangles(points, triangles)
    used, corners = np.unique(triangles, return_inverse=True)
    corners = corners.reshape(-1, 3)
    box = UnitBox.of(points[used])
    placed = box.placed(points[used])
    corners = corners[area_vectors(placed, corners).any(axis=1)]
    if not len(corners):
        raise MeshError("a surface was expected, found only faces without area; there is nothing to wrap")
    wrap = _unit_wrap(placed, corners, alpha, offset)
    return wrap.moved(box.restored(wrap.points))


def finite_triangles(points: Floats, triangles: Indices) -> Indices:
    """Return the triangles, at least one, whose corners are finite.

    Raises
    ------
    MeshError
        If there are none.
    """
    finite = triangles[np.isfinite(points[triangles]).all(axis=(1, 2))]
    if not len(finite):
        raise MeshError(f"a surface was expected, found no faces with finite corners among {len(triangles)} triangles")
    return finite


def from_triangles(points: Floats, triangles: Indices) -> PolygonMesh:
    """Return triangles, (t, 3) int, on points, (n, 3) float, as a polygon mesh; they may have any fault."""
    return PolygonMesh(points, np.ravel(triangles), 3 * np.arange(len(triangles) + 1))


def _unit_wrap(points: Floats, triangles: Indices, alpha: float, offset: float) -> PolygonMesh:
    """Wrap triangles whose bounding box has a diagonal of 1."""
    lab = mesh_lab()
    with silenced():
        meshes = lab.MeshSet(verbose=False)
        meshes.add_mesh(lab.Mesh(points, triangles))
        meshes.generate_alpha_wrap(alpha=lab.PureValue(alpha), offset=lab.PureValue(offset))
        result = meshes.current_mesh()
        return from_triangles(result.vertex_matrix(), result.face_matrix().astype(np.int64))
