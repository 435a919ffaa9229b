"""Every config that comes with the program loads, says what it shows, and asks for what can be printed."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from fabricate.config import (
    Config,
    FileConfig,
    KnotConfig,
    SphereConfig,
    TorusConfig,
    config_sha256,
    load_config,
)
from fabricate.formats.source import source_mesh
from fabricate.mesh.closed import genus
from fabricate.prepare.density import neck_share
from fabricate.process import PROCESSES

PATHS = sorted((Path(__file__).parents[1] / "configs").rglob("*.toml"))
each_path = pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
Configs = dict[str, Config]


@pytest.fixture(scope="module")
def configs() -> Configs:
    return {path.stem: load_config(path) for path in PATHS}


def test_there_are_enough() -> None:
    assert len(PATHS) >= 10


@each_path
def test_names_are_short(path: Path) -> None:
    assert re.fullmatch(r"[a-z0-9-]{3,16}", path.stem)


@each_path
def test_it_begins_with_one_comment_line(path: Path) -> None:
    first, second, *_ = path.read_text(encoding="utf-8").splitlines()
    assert re.fullmatch(r"# [A-Z].*\.", first)
    assert len(first) <= 110
    assert second == "[source]"


@each_path
def test_it_loads(path: Path) -> None:
    assert load_config(path)


def test_no_two_ask_for_the_same(configs: Configs) -> None:
    assert len({config_sha256(config) for config in configs.values()}) == len(configs)


def test_every_number_of_handles_is_shown(configs: Configs) -> None:
    handles = {genus(source_mesh(config.source)) for config in configs.values()}
    assert handles == {0, 1, 2, 3, 6}


def test_every_kind_of_choice_is_shown(configs: Configs) -> None:
    every = configs.values()
    assert {config.pattern.tree for config in every} == {"random", "breadth-first", "depth-first"}
    spheres = [config.source for config in every if isinstance(config.source, SphereConfig)]
    assert {sphere.faces for sphere in spheres} == {"triangles", "pentagons", "hexagons", "octagons"}
    assert any(isinstance(config.source, KnotConfig) for config in every)
    assert any(config.solid.core != "hollow" for config in every)
    assert any(config.solid.clearance == 0.0 for config in every)
    assert {"fdm", "sla"} <= {config.process.name for config in every}


def test_nothing_has_to_be_downloaded(configs: Configs) -> None:
    assert not [name for name, config in configs.items() if isinstance(config.source, FileConfig)]


def test_the_first_one_is_that_of_the_readme(configs: Configs) -> None:
    first = configs["first"]
    assert isinstance(first.source, TorusConfig)
    assert (first.source.size, first.pattern.tile_size, first.pattern.seed) == (100.0, 7.0, 7)
    assert (first.solid.thickness, first.solid.clearance) == (2.4, 0.3)


@each_path
def test_necks_and_walls_of_square_tiles_come_out_of_the_printer(path: Path) -> None:
    config = load_config(path)
    process, tile = PROCESSES[config.process.name], config.pattern.tile_size
    assert isinstance(tile, float)
    assert neck_share(config.pattern.positions) * tile - config.solid.clearance >= process.feature_min
    assert config.solid.thickness >= process.wall_min
    assert config.solid.clearance == 0.0 or config.solid.clearance >= process.gap_default
