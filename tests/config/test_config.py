"""A whole config: the one of the contract, and values that are right alone but not together."""

from collections.abc import Callable

import pytest
from pydantic import ValidationError

from fabricate.config import Config, CubeConfig, PatternConfig, SolidConfig, TorusConfig
from fabricate.config.solid_config import BaseConfig, OpeningsConfig


def test_the_example_of_the_contract(read: Callable[..., Config]) -> None:
    config = read(
        """
        [source]
        shape = "torus"
        size = "100 mm"
        [pattern]
        tile_size = "7 mm"
        tree = "random"
        seed = 7
        [solid]
        thickness = "2.4 mm"
        core = "hollow"
        clearance = "0.3 mm"
        tolerance = "0.05 mm"
        [process]
        name = "fdm"
        """
    )
    assert config == Config(source=TorusConfig(), pattern=PatternConfig(seed=7))
    assert (config.source.size, config.solid.thickness, config.solid.clearance) == (100.0, 2.4, 0.3)


def test_a_config_cannot_be_edited() -> None:
    config = Config(source=CubeConfig())
    with pytest.raises(ValidationError):
        config.solid = SolidConfig(thickness=1.0)  # type: ignore[misc]


@pytest.mark.parametrize(
    ("solid", "pattern", "key"),
    [
        (SolidConfig(thickness=25.0), PatternConfig(), "solid.thickness"),
        (SolidConfig(thickness=1.0, clearance=4.0), PatternConfig(), "solid.clearance"),
        (SolidConfig(), PatternConfig(tile_size=50.1), "pattern.tile_size"),
        (SolidConfig(openings=OpeningsConfig(diameter=50.1)), PatternConfig(), "solid.openings.diameter"),
        (SolidConfig(base=BaseConfig(height=50.1)), PatternConfig(), "solid.base.height"),
    ],
)
def test_values_that_do_not_fit_together_are_refused(solid: SolidConfig, pattern: PatternConfig, key: str) -> None:
    with pytest.raises(ValidationError) as caught:
        Config(source=CubeConfig(size=50.0), solid=solid, pattern=pattern)
    assert caught.value.errors()[0]["ctx"]["key"] == key


def test_values_just_inside_fit() -> None:
    assert Config(
        source=CubeConfig(size=50.0),
        solid=SolidConfig(
            thickness=24.9, clearance=99.0, openings=OpeningsConfig(diameter=50.0), base=BaseConfig(height=50.0)
        ),
        pattern=PatternConfig(tile_size=50.0),
    )
