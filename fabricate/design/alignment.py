"""How closely the corridors of a duotone follow directions on the surface."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.limit import limit_vertices
from fabricate.triangles.normals import unit


def alignment_costs(quads: QuadMesh, directions: Floats) -> Floats:
    """Return |cos| of the angles between each tile's diagonals and a direction, (t, 2) float: yellow, blue.

    A corridor runs along the diagonal that is joined. Diagonals are straight lines between corners on the limit
    surface.

    Parameters
    ----------
    quads : QuadMesh
    directions : (t, 3) float
        A unit tangent vector for each tile; zero, for which both are 0, where there is none.
    """
    corners = limit_vertices(quads)[quads.tiles]
    diagonals = [unit(corners[:, k + 2] - corners[:, k]) for k in (0, 1)]
    costs: Floats = np.abs(np.stack([(each * directions).sum(axis=1) for each in diagonals], axis=1))
    return costs


def alignment(duotone: Duotone, directions: Floats) -> float:
    """Return the mean |cos| between the joined diagonals of both colours and their tiles' directions.

    1 where all corridors run along the directions, 0 where all run across, about 0.64 where they do as chance has it.
    Tiles whose direction is zero do not count; without any that does, it is 0.
    """
    directed = directions.any(axis=1)
    costs = alignment_costs(duotone.quads, directions)[directed]
    joined = np.where(duotone.joined[directed], costs[:, 0], costs[:, 1])
    return float(joined.mean()) if len(joined) else 0.0
