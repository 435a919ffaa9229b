"""Fields become weights: low first, ties equal, chance as much as asked."""

from __future__ import annotations

import numpy as np
import pytest
from round_tiles import round_tiles
from scipy.stats import spearmanr

from fabricate.config import (
    AttributeConfig,
    CurvatureConfig,
    DirectionConfig,
    DistanceConfig,
    FieldConfig,
    HeightConfig,
    ImageConfig,
)
from fabricate.design.field import LEVELS, FieldWish, field_directions, field_weights
from fabricate.formats.point_values import PointValues
from fabricate.mesh.torus import torus
from fabricate.surface.sizing import sized, tiled
from fabricate.surface.tile_places import TilePlaces

CAGE = sized(torus(around=16, across=8, tube=0.45), size=60)
RING = tiled(CAGE, tile_size=4)
PLACES = TilePlaces.of(RING)
X, Y, Z = PLACES.middle.T


def weights(field: FieldConfig, source: np.ndarray | PointValues | None = None, seed: int = 0) -> np.ndarray:
    return field_weights(RING, FieldWish(field, source), seed=seed)


def assert_like(found: np.ndarray, values: np.ndarray) -> None:
    """Weights are the values, but for where they begin and how far they go."""
    assert found.min() == 0.0
    assert found.max() == LEVELS
    assert found == pytest.approx((values - values.min()) / np.ptp(values) * LEVELS, abs=1.0)


def test_height_is_that_along_its_axis() -> None:
    assert_like(weights(HeightConfig(kind="height")), Z)
    assert_like(weights(HeightConfig(kind="height", axis=(3.0, -4.0, 0.0))), 3 * X - 4 * Y)


def test_distance_is_to_a_point_or_an_axis_or_the_middle() -> None:
    point = (10.0, -5.0, 2.0)
    away = PLACES.middle - np.array(point)
    assert_like(weights(DistanceConfig(kind="distance", point=point)), np.linalg.norm(away, axis=1))
    field = DistanceConfig(kind="distance", point=point, axis=(0.0, 0.0, 2.0))
    assert_like(weights(field), np.hypot(away[:, 0], away[:, 1]))
    middle = PLACES.middle - PLACES.centre
    assert_like(weights(DistanceConfig(kind="distance")), np.linalg.norm(middle, axis=1))


def test_curvature_is_the_larger_one() -> None:
    pole, flank = round_tiles(size=40), round_tiles(size=40)
    points = pole.points * [1.0, 1.0, 3.0]  # a cigar: its ends are sharp
    cigar = type(flank)(points, flank.tiles, flank.twins, flank.yellow)
    found = field_weights(cigar, FieldWish(CurvatureConfig(kind="curvature")), seed=0)
    height = np.abs(TilePlaces.of(cigar).middle[:, 2])
    assert spearmanr(found, height).statistic > 0.9


def test_a_picture_is_seen_from_its_axis() -> None:
    ramp = np.tile(np.arange(64.0), (64, 1))
    found = weights(ImageConfig(kind="image", image="some.png", axis=(0.0, 0.0, 1.0)), ramp)
    assert spearmanr(found, X).statistic > 0.999


def test_an_attribute_is_that_of_the_nearest_place() -> None:
    found = weights(AttributeConfig(kind="attribute", attribute="x"), PointValues(CAGE, CAGE.points[:, 0]))
    assert spearmanr(found, X).statistic > 0.99


def test_a_scaled_wish_has_its_mesh_scaled() -> None:
    wish = FieldWish(AttributeConfig(kind="attribute", attribute="x"), PointValues(CAGE, CAGE.points[:, 0]))
    small = FieldWish(wish.config, PointValues(CAGE.scaled(1e-3), CAGE.points[:, 0]))
    assert small.of_mesh
    assert (field_weights(RING, small.scaled(1e3), seed=0) == field_weights(RING, wish, seed=0)).all()
    height = FieldWish(HeightConfig(kind="height"))
    assert not height.of_mesh
    assert height.scaled(2.0) is height


@pytest.mark.parametrize("kind", ["height", "distance", "curvature"])
def test_reversed_weights_are_in_opposite_order(kind: str) -> None:
    model = {"height": HeightConfig, "distance": DistanceConfig, "curvature": CurvatureConfig}[kind]
    plain = weights(model.model_validate({"kind": kind}))
    back = weights(model.model_validate({"kind": kind, "reverse": True}))
    assert plain + back == pytest.approx(LEVELS, abs=2.0)


def test_across_is_along_the_other_way_round() -> None:
    along, across = (weights(DirectionConfig(kind="direction", corridors=way)) for way in ("along", "across"))
    assert along + across == pytest.approx(LEVELS, abs=2.0)


def test_rounding_makes_no_difference_between_equals() -> None:
    nearly = np.where(np.arange(len(CAGE.points)) % 2, 1.0, 1.0 + 1e-13)
    nearly[0] = 2.0
    found = weights(AttributeConfig(kind="attribute", attribute="x"), PointValues(CAGE, nearly))
    assert (found == 0.0).mean() > 0.9


def test_a_constant_field_has_equal_weights() -> None:
    found = weights(AttributeConfig(kind="attribute", attribute="x"), PointValues(CAGE, np.full(len(CAGE.points), 7.0)))
    assert not found.any()


def test_jitter_is_drawn_from_the_seed_and_bounded_by_its_share() -> None:
    first, second, other = (weights(HeightConfig(kind="height", jitter=0.2), seed=seed) for seed in (1, 1, 2))
    assert (first == second).all()
    assert (first != other).any()
    level = (Z - Z.min()) / np.ptp(Z)
    added = first / LEVELS - level  # begun anew where the sum is lowest
    assert -0.2 <= added.min() < added.max() <= 0.2
    assert np.ptp(added) > 0.15
    assert spearmanr(first, Z).statistic < 0.999


def test_only_directions_have_directions() -> None:
    assert field_directions(RING, FieldWish(HeightConfig(kind="height"))) is None
    found = field_directions(RING, FieldWish(DirectionConfig(kind="direction")))
    assert found is not None
    assert found.shape == (len(RING.tiles), 3)


def test_what_was_not_read_is_missed() -> None:
    with pytest.raises(ValueError, match="kind image has to come with what was read"):
        weights(ImageConfig(kind="image", image="some.png"))
