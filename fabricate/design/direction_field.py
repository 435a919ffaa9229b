"""Directions on the surface, tile by tile, that corridors follow or cross."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats
from fabricate.config.field_config import DirectionConfig
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.curvature import tile_curvatures
from fabricate.surface.tile_places import TilePlaces
from fabricate.triangles.normals import unit

STEEP = 0.02
"""A vector that a surface meets this squarely, as the sine of the angle to its normal, has no direction on it."""


def tile_directions(quads: QuadMesh, field: DirectionConfig) -> Floats:
    """Return a unit tangent vector for each tile, (t, 3) float; zero where the field has no direction."""
    match field.lines:
        case "most-curved":
            return tile_curvatures(quads).directions[:, 0]
        case "least-curved":
            return tile_curvatures(quads).directions[:, 1]
        case "circles":
            places = TilePlaces.of(quads)
            point = places.centre if field.point is None else np.asarray(field.point)
            return _tangent(unit(np.cross(field.axis, places.middle - point)), places.normal)
        case "vector":
            vector = np.asarray(field.axis) / np.linalg.norm(field.axis)
            return _tangent(vector[None, :], TilePlaces.of(quads).normal)


def _tangent(vectors: Floats, normals: Floats) -> Floats:
    """Return unit vectors, (t, 3) or (1, 3), turned into the planes of unit normals, (t, 3), at length 1."""
    flat = vectors - (vectors * normals).sum(axis=1, keepdims=True) * normals
    flat[np.linalg.norm(flat, axis=1) < STEEP] = 0.0
    return unit(flat)
