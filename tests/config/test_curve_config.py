"""The curve's own keys: a wire that is no thread, and views that exist."""

import pytest
from pydantic import ValidationError

from fabricate.config import Config, CubeConfig, CurveConfig, PatternConfig


def test_nothing_is_made_of_the_curve_unless_asked_for() -> None:
    assert (CurveConfig().wire, CurveConfig().views) == (None, ())


def test_views_are_a_list_of_sides() -> None:
    assert CurveConfig.model_validate({"views": ["front", "top"]}).views == ("front", "top")


def test_a_wire_runs_along_one_curve() -> None:
    curve = CurveConfig(wire=1.0)
    assert Config(source=CubeConfig(), pattern=PatternConfig(rings="two"), curve=curve).curve.wire == 1.0
    with pytest.raises(ValidationError, match=r"one curve, found pattern\.rings of 2"):
        Config(source=CubeConfig(), pattern=PatternConfig(rings="three"), curve=curve)


@pytest.mark.parametrize("keys", [{"views": ["above"]}, {"views": "front"}, {"wire": 0.05}, {"hidden": "dashed"}])
def test_what_is_no_view_and_no_wire_is_refused(keys: dict[str, object]) -> None:
    with pytest.raises(ValidationError):
        CurveConfig.model_validate(keys)
