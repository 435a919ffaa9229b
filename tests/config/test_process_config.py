"""The process decides walls and gaps that are not given, in files and from Python alike."""

from collections.abc import Callable

import pytest

from fabricate.config import Config, CubeConfig, ProcessConfig, SolidConfig
from fabricate.config.process_config import PROCESS_DEFAULTS, with_process_defaults
from fabricate.process import PROCESSES

CUBE = '[source]\nshape = "cube"\n'


@pytest.mark.parametrize("name", PROCESSES)
def test_walls_and_gaps_follow_the_process(read: Callable[..., Config], name: str) -> None:
    process = PROCESSES[name]
    solid = read(f'{CUBE}[process]\nname = "{name}"').solid
    assert (solid.thickness, solid.clearance) == (process.wall_default, process.gap_default)


def test_what_is_given_wins_over_the_process(read: Callable[..., Config]) -> None:
    solid = read(f'{CUBE}[solid]\nclearance = "0 mm"\n[process]\nname = "mjf"').solid
    assert (solid.thickness, solid.clearance) == (2.0, 0.0)


def test_from_python_too() -> None:
    config = Config(source=CubeConfig(size=50), process=ProcessConfig(name="sla"))
    assert (config.solid.thickness, config.solid.clearance) == (1.5, 0.25)


def test_the_section_alone_shows_the_defaults_of_the_default_process() -> None:
    default = PROCESSES[ProcessConfig().name]
    for key, attribute in PROCESS_DEFAULTS.items():
        assert getattr(SolidConfig(), key) == getattr(default, attribute)


@pytest.mark.parametrize(
    "document", [3, {"solid": 3}, {"process": 3}, {"process": {"name": "fmd"}}, {"process": {"name": []}}]
)
def test_what_validation_will_refuse_is_left_to_it(document: object) -> None:
    assert with_process_defaults(document) is document
