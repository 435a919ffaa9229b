"""A resolved config gives itself, and its digest is that of what it means."""

import tomllib
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from fabricate.config import (
    Config,
    CubeConfig,
    CurveConfig,
    DirectionConfig,
    FileConfig,
    FrameConfig,
    HeightConfig,
    ImageConfig,
    KnotConfig,
    LockConfig,
    PatternConfig,
    ProcessConfig,
    SolidConfig,
    SphereConfig,
    ThicknessConfig,
    TorusConfig,
    load_config,
)
from fabricate.config.resolved import config_sha256, moved_config, resolved_toml
from fabricate.config.section import ConfigFolder

SIZES = st.floats(min_value=50, max_value=10_000)
PROCESS_NAMES = st.sampled_from(["fdm", "sla", "sls", "mjf"])
SPHERES = st.builds(SphereConfig, size=SIZES, frequency=st.integers(1, 32)) | st.builds(
    SphereConfig, size=SIZES, faces=st.sampled_from(["pentagons", "hexagons", "octagons"])
)
SOURCE = st.one_of(
    SPHERES,
    st.builds(CubeConfig, size=SIZES, divisions=st.integers(1, 64)),
    st.builds(TorusConfig, size=SIZES, around=st.integers(3, 512), tube=st.floats(0.01, 0.99)),
    st.builds(FrameConfig, shape=st.sampled_from(["double-torus", "triple-torus", "genus-6"]), size=SIZES),
    st.builds(KnotConfig, size=SIZES, across=st.integers(3, 64)),
    st.builds(FileConfig, path=st.text(st.characters(exclude_categories=["Cs", "Cc"]), min_size=1), size=SIZES),
)
PATTERN = (
    st.builds(
        PatternConfig,
        tile_size=st.floats(min_value=1e-6, max_value=50),
        tree=st.sampled_from(["random", "breadth-first", "depth-first"]),
        seed=st.integers(min_value=0),
        arc=st.floats(0.293, 0.707, exclude_min=True, exclude_max=True),
    )
    | st.builds(
        PatternConfig,
        levels=st.integers(0, 12),
        rings=st.sampled_from(["two", "three", "four"]) | st.floats(0.3, 0.7).map(lambda ring: (ring, ring + 0.005)),
    )
    | st.builds(PatternConfig, area_share=st.floats(0, 1, exclude_min=True, exclude_max=True))
)
CURVE = st.builds(
    CurveConfig,
    views=st.lists(st.sampled_from(["front", "back", "left", "right", "top", "bottom"])).map(tuple),
    hidden=st.sampled_from(["left-out", "lighter"]),
)
SOLID = st.builds(
    SolidConfig,
    thickness=st.floats(0.1, 20)
    | st.builds(
        ThicknessConfig, min=st.floats(0.1, 2), max=st.floats(2, 20), by=st.sampled_from(["height", "curvature"])
    ),
    core=st.sampled_from(["hollow", "blue", "yellow"]),
    clearance=st.floats(0, 0.4, exclude_max=True),
    tolerance=st.floats(min_value=1e-6, max_value=10),
)
CONFIGS = st.builds(
    Config,
    source=SOURCE,
    pattern=PATTERN,
    curve=CURVE,
    solid=SOLID,
    process=st.builds(ProcessConfig, name=PROCESS_NAMES),
)


FIELD = st.builds(HeightConfig, kind=st.just("height"), reverse=st.booleans(), jitter=st.floats(0, 1)) | st.builds(
    DirectionConfig, kind=st.just("direction"), point=st.none() | st.tuples(*3 * [st.floats(-50, 50)])
)
LOCKS = st.lists(
    st.builds(LockConfig, joined=st.sampled_from(["yellow", "blue"]), tiles=st.just((1, 2)))
    | st.builds(LockConfig, joined=st.just("blue"), near=st.just((0.0, 0.0, 1.5)), within=st.floats(0.1, 9)),
    min_size=1,
).map(tuple)
FOLLOWING = st.builds(
    Config, source=SOURCE, pattern=st.builds(PatternConfig, tree=st.just("field"), locks=LOCKS), field=FIELD
)


def reread(text: str) -> Config:
    return Config.model_validate(tomllib.loads(text), context=ConfigFolder(Path()))


@given(CONFIGS | FOLLOWING)
def test_a_resolved_config_gives_itself(config: Config) -> None:
    text = resolved_toml(config)
    again = reread(text)
    assert again == config
    assert resolved_toml(again) == text
    assert config_sha256(again) == config_sha256(config)


@given(CONFIGS, CONFIGS)
def test_the_digest_tells_configs_apart(one: Config, other: Config) -> None:
    assert (config_sha256(one) == config_sha256(other)) == (one == other)


def test_defaults_are_written_out_and_lengths_have_units() -> None:
    document = tomllib.loads(resolved_toml(Config(source=TorusConfig(), process=ProcessConfig(name="sls"))))
    assert document["solid"]["thickness"] == "2 mm"
    assert document["solid"]["clearance"] == "0.5 mm"
    assert document["pattern"]["tile_size"] == "7 mm"
    assert "levels" not in document["pattern"]
    assert document["source"]["shape"] == "torus"


def test_what_is_written_differently_but_means_the_same_has_one_digest(tmp_path: Path) -> None:
    long, short = tmp_path / "long.toml", tmp_path / "short.toml"
    long.write_text('[source]\nsize = "10 cm"\nshape = "cube"\n[process]\nname = "fdm"\n')
    short.write_text('source.shape = "cube" # small\n')
    assert config_sha256(load_config(long)) == config_sha256(load_config(short))


def test_a_mesh_file_is_written_as_it_was_given(tmp_path: Path) -> None:
    path = tmp_path / "some.toml"
    path.write_text('[source]\npath = "models/spot.obj"')
    text = resolved_toml(load_config(path))
    assert 'path = "models/spot.obj"' in text
    assert str(tmp_path) not in text


def test_a_config_in_another_folder_finds_the_same_mesh(tmp_path: Path) -> None:
    path = tmp_path / "configs" / "some.toml"
    path.parent.mkdir()
    path.write_text('[source]\npath = "../models/spot.obj"')
    config = load_config(path)
    moved = tmp_path / "outputs" / "some" / "config.toml"
    moved.parent.mkdir(parents=True)
    moved.write_text(resolved_toml(moved_config(config, moved.parent)))
    again = load_config(moved).source
    assert isinstance(again, FileConfig)
    assert again.file.resolve() == (tmp_path / "models" / "spot.obj").resolve()


def test_a_config_in_another_folder_finds_the_same_picture(tmp_path: Path) -> None:
    path = tmp_path / "configs" / "some.toml"
    path.parent.mkdir()
    path.write_text(
        '[source]\nshape = "cube"\n[pattern]\ntree = "field"\n[field]\nkind = "image"\nimage = "../a/star.png"'
    )
    moved = tmp_path / "outputs" / "some" / "config.toml"
    moved.parent.mkdir(parents=True)
    moved.write_text(resolved_toml(moved_config(load_config(path), moved.parent)))
    again = load_config(moved).field
    assert isinstance(again, ImageConfig)
    assert again.file.resolve() == (tmp_path / "a" / "star.png").resolve()


def test_a_shape_is_the_same_everywhere(tmp_path: Path) -> None:
    config = Config(source=TorusConfig())
    assert moved_config(config, tmp_path) is config
