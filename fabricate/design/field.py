"""Fields: what a tree follows, as one weight for each tile."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats
from fabricate.config.field_config import (
    AttributeConfig,
    CurvatureConfig,
    DirectionConfig,
    DistanceConfig,
    FieldConfig,
    HeightConfig,
    ImageConfig,
)
from fabricate.design.alignment import alignment_costs
from fabricate.design.direction_field import tile_directions
from fabricate.design.nearest_values import nearest_values
from fabricate.design.projected_image import projected
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.formats.field_source import FieldSource
from fabricate.formats.point_values import PointValues
from fabricate.surface.curvature import tile_curvatures
from fabricate.surface.tile_places import TilePlaces

LEVELS = 1e9
"""Into how many levels a field's range is divided: what differs by less is equal, and rounding decides nothing."""


@dataclass(frozen=True, eq=False)
class FieldWish:
    """A field as it is asked for, and what was read for it.

    Attributes
    ----------
    config : FieldConfig
        Which field.
    source : (height, width) float, PointValues or None
        The picture's luminance, or the values of a mesh; in mm where a mesh has become the body's size.
    """

    config: FieldConfig
    source: FieldSource = None

    @property
    def of_mesh(self) -> bool:
        """Whether values of a mesh were read."""
        return isinstance(self.source, PointValues)

    def scaled(self, factor: float) -> FieldWish:
        """Return the field with the mesh whose values it has, if any, scaled as the body is."""
        return FieldWish(self.config, self.source.scaled(factor)) if isinstance(self.source, PointValues) else self


def field_directions(quads: QuadMesh, wish: FieldWish) -> Floats | None:
    """Return the directions of a field, (t, 3) float as `tile_directions` does; None if it is one of values."""
    return tile_directions(quads, wish.config) if isinstance(wish.config, DirectionConfig) else None


def field_weights(quads: QuadMesh, wish: FieldWish, *, seed: int) -> Floats:
    """Return a weight for each tile, (t,) float: the tree joins light tiles in yellow first.

    The weight of a tile in a field of values is the value in its middle, or its negative if the field is reversed.
    In a field of directions it is the |cos| of its blue diagonal less that of its yellow one, or the negative where
    corridors run across: yellow in one tile is blue given up in it, so that of all trees the lightest is the one
    with the largest, or smallest, mean alignment. Weights are in whole steps, a billion over their range, and
    `jitter` adds up to its share of the range, drawn from `seed`.
    """
    config = wish.config
    values = _values(quads, wish)
    if not isinstance(config, DirectionConfig) and config.reverse:
        values = -values
    span = float(np.ptp(values))
    if span * LEVELS <= float(np.abs(values).max()):
        values, span = np.zeros_like(values), 0.0
    if config.jitter > 0.0:
        values = values + config.jitter * (span or 1.0) * np.random.default_rng(seed).random(len(values))
    weights: Floats = np.rint((values - values.min()) * (LEVELS / (span or 1.0)))
    return weights


def _values(quads: QuadMesh, wish: FieldWish) -> Floats:
    """Return the value of a field in the middle of each tile, (t,) float."""
    match wish.config, wish.source:
        case HeightConfig(axis=axis), _:
            return np.asarray(_middles(quads) @ (np.asarray(axis) / np.linalg.norm(axis)))
        case DistanceConfig() as distance, _:
            return _distances(TilePlaces.of(quads), distance)
        case CurvatureConfig(), _:
            return np.asarray(np.abs(tile_curvatures(quads).values[:, 0]))
        case DirectionConfig() as direction, _:
            yellow, blue = alignment_costs(quads, tile_directions(quads, direction)).T
            return np.asarray(blue - yellow if direction.corridors == "along" else yellow - blue)
        case ImageConfig(axis=axis), np.ndarray() as luminance:
            return projected(luminance, _middles(quads), axis=np.asarray(axis))
        case AttributeConfig(), PointValues() as known:
            return nearest_values(known, _middles(quads))
    raise ValueError(f"a field of kind {wish.config.kind} has to come with what was read for it")


def _middles(quads: QuadMesh) -> Floats:
    return TilePlaces.of(quads).middle


def _distances(places: TilePlaces, field: DistanceConfig) -> Floats:
    """Return the distance from each tile to the point or axis, (t,) float, mm."""
    away = places.middle - (places.centre if field.point is None else np.asarray(field.point))
    if field.axis is not None:
        away = np.cross(away, np.asarray(field.axis) / np.linalg.norm(field.axis))
    distances: Floats = np.linalg.norm(away, axis=1)
    return distances
