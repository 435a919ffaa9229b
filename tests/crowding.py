"""Duotones with roomy tiles, and with tiles that were pulled together in one place."""

from __future__ import annotations

import numpy as np

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.crease import creased
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.torus import torus
from fabricate.surface.sizing import sized, tiled


def roomy_torus() -> Duotone:
    mesh = sized(torus(around=8, across=4, tube=0.45), size=60)
    return grown_duotone(tiled(mesh, tile_size=12), tree="random", seed=3)


def crowded_cage() -> PolygonMesh:
    """A torus's cage, some of whose points have been pulled together."""
    mesh = sized(torus(around=16, across=8, tube=0.45), size=60)
    grid = np.arange(16 * 8).reshape(16, 8)
    pinched = np.roll(grid, (1, 1), axis=(0, 1))[:3, :3].ravel()
    points = mesh.points.copy()
    middle = points[pinched].mean(axis=0)
    points[pinched] = middle + 0.05 * (points[pinched] - middle)
    return PolygonMesh(points, mesh.corners, mesh.offsets)


def crowded_torus() -> Duotone:
    return grown_duotone(subdivided(crowded_cage(), levels=1), tree="random", seed=3)


def crowded_box() -> Duotone:
    """A cube with sharp edges, one of whose sides has points pulled together towards an edge."""
    mesh = sized(creased(cube(divisions=6), angle=40.0), size=60)
    points = mesh.points.copy()
    top = np.isclose(points[:, 2], 30)
    points[:, 0] += np.where(top & np.isclose(points[:, 0], 20), 9.4, 0.0)
    near = np.isclose(points[:, 2], 20) & np.isclose(points[:, 0], 30)
    points[:, 2] += np.where(near, 9.4, 0.0)
    return grown_duotone(subdivided(mesh.moved(points), levels=1), tree="random", seed=3)
