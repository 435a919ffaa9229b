"""Sources: every shape needs only its name, each has its own keys, and a file is found from its config."""

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import get_args

import pytest
from pydantic import ValidationError

from fabricate.config import Config, FileConfig, FrameConfig, KnotConfig, SourceConfig, SphereConfig
from fabricate.config.source_config import SHAPES

Read = Callable[..., Config]


@pytest.mark.parametrize("shape", SHAPES)
def test_every_shape_needs_nothing_but_its_name(read: Read, shape: str) -> None:
    config = read(f'[source]\nshape = "{shape}"')
    assert type(config.source) is SHAPES[shape]
    assert config.source.size == 100.0


def test_every_source_is_a_shape_or_a_file() -> None:
    assert {*SHAPES.values(), FileConfig} == set(get_args(SourceConfig))


def test_frames_keep_which_one_they_are(read: Read) -> None:
    source = read('[source]\nshape = "genus-6"\nhole = 0.7').source
    assert isinstance(source, FrameConfig)
    assert (source.shape, source.hole) == ("genus-6", 0.7)


def test_the_knot_is_thick_unless_told_otherwise() -> None:
    knot = KnotConfig()
    assert (knot.around, knot.across, knot.tube) == (60, 8, 0.6)


@pytest.mark.parametrize("faces", ["pentagons", "hexagons", "octagons"])
def test_only_triangles_are_split(faces: str) -> None:
    assert SphereConfig.model_validate({"faces": faces}).frequency == 1
    with pytest.raises(ValidationError, match=f'only faces = "triangles" can be split, found .*"{faces}"'):
        SphereConfig.model_validate({"faces": faces, "frequency": 2})


def test_a_mesh_file_is_found_from_the_folder_of_the_config(read: Read, tmp_path: Path) -> None:
    source = read('[source]\npath = "models/spot.obj"').source
    assert isinstance(source, FileConfig)
    assert source.path == "models/spot.obj"
    assert source.file == tmp_path / "models" / "spot.obj"


def test_an_absolute_path_stays_what_it_is(tmp_path: Path) -> None:
    assert FileConfig(path=str(tmp_path / "spot.obj")).file == tmp_path / "spot.obj"


def test_a_config_reaches_another_process_whole(read: Read) -> None:
    config = read('[source]\npath = "spot.obj"')
    copy = pickle.loads(pickle.dumps(config))  # noqa: S301
    assert copy == config
    assert copy.source.file == config.source.file
