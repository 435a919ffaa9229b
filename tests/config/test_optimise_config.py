"""Nothing is optimised unless it counts."""

import pytest
from pydantic import ValidationError

from fabricate.config import Config, OptimiseConfig, TorusConfig
from fabricate.config.field_config import DirectionConfig, HeightConfig


def test_nothing_counts_unless_asked() -> None:
    assert OptimiseConfig().total == 0
    assert Config(source=TorusConfig()).optimise.total == 0


def test_what_is_asked_the_other_way_round_counts_as_well() -> None:
    assert OptimiseConfig(neck=1, tips=-2, corridor=-0.5).total == 3.5


@pytest.mark.parametrize(
    "keys", [{"neck": -1}, {"evenness": -1}, {"alignment": -1}, {"tips": "few"}, {"flips": -1}, {"seconds": 0}]
)
def test_what_makes_no_sense_is_refused(keys: dict[str, object]) -> None:
    with pytest.raises(ValidationError):
        OptimiseConfig.model_validate(keys)


def test_alignment_needs_directions() -> None:
    optimise = OptimiseConfig(alignment=1)
    for field in (None, HeightConfig(kind="height")):
        with pytest.raises(ValidationError, match=r'expected a section \[field\] of kind = "direction"'):
            Config(source=TorusConfig(), optimise=optimise, field=field)
    assert Config(source=TorusConfig(), optimise=optimise, field=DirectionConfig(kind="direction")).field is not None


def test_a_field_that_nothing_follows_is_refused() -> None:
    with pytest.raises(ValidationError, match="nothing follows this field"):
        Config(source=TorusConfig(), optimise=OptimiseConfig(tips=1), field=DirectionConfig(kind="direction"))
