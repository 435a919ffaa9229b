"""Shapes with many holes: two copies of a polygon mesh, every face pierced ("rind modelling")."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.errors import MeshError
from fabricate.mesh.polygon_mesh import PolygonMesh


def pierced(outer: PolygonMesh, inner_points: Floats, *, hole: float) -> PolygonMesh:
    """Return the frame of quads between two copies of a mesh, with a hole through every face.

    On both copies a face becomes a ring of quads between its polygon and the same polygon shrunk towards
    the mean of its corners. A wall of quads through the hole joins the shrunk polygons, and where the mesh
    has a boundary, quads join the two copies. Section of one bar, p on the mesh, s on shrunk polygons:

        outer copy   s---p---s
        wall         |       |  wall
        inner copy   s---p---s

    Parameters
    ----------
    outer : PolygonMesh
        v points, f faces, h corners and b boundary edges: a closed mesh, or a plate with a boundary.
    inner_points : (v, 3) float
        The other end of the frame at each point, on the side that faces look away from.
    hole : float
        Size of each hole as a fraction of its face, between 0 and 1.

    Returns
    -------
    PolygonMesh
        2 v + 2 h points: the outer copy, the inner copy, then the shrunk polygons of either. 3 h + b quads.
        The genus is f - 1 for a mesh like a sphere and f for a mesh like a disc.

    Raises
    ------
    MeshError
        If there is not one inner point for each outer one, or the hole is not between 0 and 1.

    References
    ----------
    E. Akleman, V. Srinivasan, J. Chen, "Interactive rind modeling", Shape Modeling International, 2003.
    """
    if inner_points.shape != outer.points.shape:
        raise MeshError(
            f"pierced: expected inner points of shape {outer.points.shape}, one for each outer point, "
            f"found {inner_points.shape}"
        )
    if not 0 < hole < 1:
        raise MeshError(f"pierced: hole must be above 0 and below 1, found {hole:g}: choose about 0.5")
    inner = outer.moved(inner_points)
    shrunk = [copy.points[copy.corners] - (1 - hole) * _spokes(copy) for copy in (outer, inner)]
    corners = _frame_quads(outer).ravel()
    points = np.concatenate([outer.points, inner.points, *shrunk])
    return PolygonMesh(points, corners, np.arange(0, len(corners) + 1, 4))


def double_torus(*, hole: float = 0.55, depth: float = 0.5) -> PolygonMesh:
    """Return a figure eight: a plate of two hexagons, each pierced. Genus 2, 44 points, 46 quads.

    Parameters
    ----------
    hole : float
        Size of a hole as a fraction of its hexagon, 0.1 to 0.9.
    depth : float
        Thickness of the plate as a fraction of a hexagon's width, 0.1 to 2. By default bars are about as
        thick as they are wide.

    Raises
    ------
    MeshError
        If `hole` or `depth` is out of range.
    """
    return _framed_plate([(0, 0), (1, 1)], hole=hole, depth=depth)


def triple_torus(*, hole: float = 0.55, depth: float = 0.5) -> PolygonMesh:
    """Return a clover: a plate of three hexagons round a point, each pierced. Genus 3, 62 points, 66 quads.

    Parameters
    ----------
    hole, depth : float
        As for `double_torus`.

    Raises
    ------
    MeshError
        If `hole` or `depth` is out of range.
    """
    return _framed_plate([(0, 0), (1, 1), (-1, 2)], hole=hole, depth=depth)


def genus_six(*, hole: float = 0.55, depth: float = 0.5) -> PolygonMesh:
    """Return a hollow pentagonal prism with all seven faces pierced. Genus 6, 80 points, 90 quads.

    Parameters
    ----------
    hole : float
        Size of a hole as a fraction of its face, 0.1 to 0.9.
    depth : float
        Thickness of the shell as a fraction of the radius of its hollow, 0.1 to 2. By default bars are
        about as thick as they are wide.

    Raises
    ------
    MeshError
        If `hole` or `depth` is out of range.
    """
    _check_range(hole=hole, depth=depth)
    prism = _pentagonal_prism()
    return pierced(prism, prism.points / (1 + depth), hole=hole)


def _spokes(mesh: PolygonMesh) -> Floats:
    """Return (h, 3): the way to each corner from the mean of its face's corners."""
    points = mesh.points[mesh.corners]
    centres = np.add.reduceat(points, mesh.offsets[:-1]) / mesh.face_sizes[:, None]
    spokes: Floats = points - centres[mesh.face_of_corner]
    return spokes


def _frame_quads(mesh: PolygonMesh) -> Indices:
    """Return (3 h + b, 4) point indices of the frame: rings on both copies, walls through holes, sides."""
    count, corner = len(mesh.points), np.arange(len(mesh.corners))
    start, end = mesh.corners, mesh.corners[mesh.next_corner]
    low_start, low_end = start + count, end + count
    near, far = corner + 2 * count, mesh.next_corner + 2 * count
    low_near, low_far = near + len(corner), far + len(corner)
    side = ~np.isin(start * count + end, end * count + start)
    rings = [(start, end, far, near), (low_end, low_start, low_near, low_far)]
    walls = (near, far, low_far, low_near)
    sides = (end[side], start[side], low_start[side], low_end[side])
    return np.concatenate([np.stack(quads, axis=1) for quads in (*rings, walls, sides)])


def _check_range(*, hole: float, depth: float) -> None:
    if not 0.1 <= hole <= 0.9:
        raise MeshError(f"frame: hole must be between 0.1 and 0.9, found {hole:g}: choose about 0.6")
    if not 0.1 <= depth <= 2:
        raise MeshError(f"frame: depth must be between 0.1 and 2, found {depth:g}: choose about 0.5")


def _framed_plate(cells: Sequence[tuple[int, int]], *, hole: float, depth: float) -> PolygonMesh:
    """Return a horizontal plate of hexagons with side 1, pierced, with its rim as wide as its other bars.

    Between two holes a bar takes its width from both cells; at the rim there is only one. So the rim is
    moved outward by the width it lacks: along the mean spoke of each point, which is 0 inside the plate.
    """
    _check_range(hole=hole, depth=depth)
    plate = _hexagons(cells)
    half = np.array([0.0, 0.0, depth * 3**0.5 / 2])
    frame = pierced(plate.moved(plate.points + half), plate.points - half, hole=hole)
    rim = np.zeros_like(plate.points)
    np.add.at(rim, plate.corners, _spokes(plate))
    rim *= (1 - hole) / np.bincount(plate.corners)[:, None]
    rest = np.zeros((len(frame.points) - 2 * len(rim), 3))
    return frame.moved(frame.points + np.concatenate([rim, rim, rest]))


def _hexagons(cells: Sequence[tuple[int, int]]) -> PolygonMesh:
    """Return a plate of regular hexagons with side 1, shared points once, centred at the origin.

    Cells and corners are named by integers (i, j) in the triangular lattice whose steps point 30 degrees
    below and above the x axis; hexagons (1, 1), (-1, 2) or (2, -1) apart are neighbours.
    """
    steps = np.array([(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)])
    lattice = (np.array(cells)[:, None] + steps).reshape(-1, 2)
    names, corners = np.unique(lattice, axis=0, return_inverse=True)
    names = names - np.mean(cells, axis=0)
    points = np.stack([names.sum(axis=1) * 3**0.5 / 2, (names[:, 1] - names[:, 0]) / 2, np.zeros(len(names))], axis=1)
    return PolygonMesh(points, corners.ravel(), np.arange(0, len(lattice) + 1, 6))


def _pentagonal_prism() -> PolygonMesh:
    """Return the pentagonal prism whose faces all touch one sphere, its ten points on the unit sphere."""
    turn = np.arange(5) * (2 * np.pi / 5)
    ring, height = np.stack([np.cos(turn), np.sin(turn)], axis=1), np.full((5, 1), np.cos(np.pi / 5))
    points = np.concatenate([np.hstack([ring, -height]), np.hstack([ring, height])])
    sides = [(i, (i + 1) % 5, (i + 1) % 5 + 5, i + 5) for i in range(5)]
    prism = PolygonMesh.from_faces(points, [(4, 3, 2, 1, 0), (5, 6, 7, 8, 9), *sides])
    return prism.scaled(1 / np.hypot(1, np.cos(np.pi / 5)))
