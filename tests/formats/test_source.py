"""Every source a config can ask for becomes a proved mesh, or an error that names the file or the key."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from fabricate.config import (
    CubeConfig,
    FileConfig,
    FrameConfig,
    KnotConfig,
    SourceConfig,
    SphereConfig,
    TorusConfig,
)
from fabricate.errors import FabricateError, MeshError, ReadError
from fabricate.formats.limits import ReadLimits
from fabricate.formats.source import read_closed, source_mesh
from fabricate.mesh.closed import checked_closed, genus

CORPUS = os.environ.get("FABRICATE_CORPUS")
BAD = sorted(Path(CORPUS, "bad").iterdir()) if CORPUS else []

TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"

SOURCES: list[tuple[SourceConfig, int, int]] = [
    (SphereConfig(), 0, 80),
    (SphereConfig(frequency=5), 0, 500),
    (SphereConfig(faces="pentagons", frequency=1), 0, 12),
    (SphereConfig(faces="hexagons", frequency=1), 0, 32),
    (SphereConfig(faces="octagons", frequency=1), 0, 26),
    (CubeConfig(divisions=2), 0, 24),
    (TorusConfig(), 1, 128),
    (FrameConfig(shape="double-torus"), 2, 46),
    (FrameConfig(shape="triple-torus"), 3, 66),
    (FrameConfig(shape="genus-6"), 6, 90),
    (KnotConfig(), 1, 480),
]


@pytest.mark.parametrize(("source", "handles", "faces"), SOURCES, ids=lambda value: repr(value)[:40])
def test_every_shape_is_a_closed_surface_of_its_genus(source: SourceConfig, handles: int, faces: int) -> None:
    mesh = source_mesh(source)
    assert checked_closed(mesh) is mesh
    assert genus(mesh) == handles
    assert len(mesh.offsets) - 1 == faces


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (TorusConfig(tube=0.3), TorusConfig(tube=0.4)),
        (KnotConfig(tube=0.3), KnotConfig(tube=0.4)),
        (FrameConfig(shape="double-torus", hole=0.5), FrameConfig(shape="double-torus", hole=0.6)),
        (FrameConfig(shape="genus-6", depth=0.5), FrameConfig(shape="genus-6", depth=0.6)),
    ],
)
def test_keys_reach_the_shape(one: SourceConfig, other: SourceConfig) -> None:
    assert not np.allclose(source_mesh(one).points, source_mesh(other).points)


AT_BOUNDS: list[SourceConfig] = [
    SphereConfig(frequency=1),
    SphereConfig(frequency=32),
    CubeConfig(divisions=1),
    CubeConfig(divisions=64),
    TorusConfig(around=3, across=3, tube=0.999),
    TorusConfig(around=512, across=256, tube=0.001),
    FrameConfig(shape="double-torus", hole=0.1, depth=0.1),
    FrameConfig(shape="triple-torus", hole=0.9, depth=2.0),
    FrameConfig(shape="genus-6", hole=0.9, depth=0.1),
    KnotConfig(around=24, across=3, tube=0.05),
    KnotConfig(around=2048, across=64, tube=0.76),
    KnotConfig(tube=0.76),
]


@pytest.mark.parametrize("source", AT_BOUNDS, ids=lambda source: repr(source)[:60])
def test_a_shape_at_the_bounds_of_the_config_can_be_made(source: SourceConfig) -> None:
    assert source_mesh(source)


@given(tube=st.floats(1, 10), across=st.integers(3, 256))
def test_a_tube_that_no_other_key_can_save_is_refused_by_the_config(tube: float, across: int) -> None:
    keys = {"around": 16, "across": across, "tube": tube}
    with pytest.raises(MeshError):
        source_mesh(TorusConfig.model_construct(**keys))
    with pytest.raises(ValidationError, match="less than 1"):
        TorusConfig(**keys)


@pytest.mark.parametrize(
    ("source", "message"),
    [
        (TorusConfig(across=4, tube=0.7), r"torus: tube must be above 0 and below 0\.667"),
        (TorusConfig(tube=1e-9), "no volume"),
        (KnotConfig(across=3), r"knot: tube must be above 0 and at most 0\.425"),
    ],
)
def test_keys_that_do_not_fit_each_other_are_errors_of_the_mesh(source: SourceConfig, message: str) -> None:
    with pytest.raises(MeshError, match=message):
        source_mesh(source)


def test_a_file_is_read_and_turned_outward(tmp_path: Path) -> None:
    path = tmp_path / "inside_out.obj"
    path.write_text(TETRAHEDRON.replace("f 1 3 2", "f 1 2 3").replace("f 1 2 4", "f 2 1 4")
                    .replace("f 2 3 4", "f 3 2 4").replace("f 3 1 4", "f 1 3 4"))  # fmt: skip
    mesh = read_closed(path)
    assert checked_closed(mesh) is mesh
    assert mesh.face_sizes.tolist() == [3, 3, 3, 3]


def test_a_file_that_is_not_closed_is_named(tmp_path: Path) -> None:
    path = tmp_path / "open.obj"
    path.write_text(TETRAHEDRON.removesuffix("f 3 1 4\n"))
    with pytest.raises(MeshError) as caught:
        read_closed(path)
    assert str(caught.value).startswith(f"{path}: the surface has an open boundary of 3 edges")


def test_a_missing_file_is_named_once(tmp_path: Path) -> None:
    with pytest.raises(ReadError) as caught:
        read_closed(tmp_path / "none.obj")
    assert str(caught.value).count("none.obj") == 1


@pytest.mark.skipif(not CORPUS, reason="FABRICATE_CORPUS is not set")
@pytest.mark.parametrize("path", BAD, ids=lambda path: path.name)
def test_bad_files_are_proved_closed_or_refused_in_one_line(path: Path) -> None:
    try:
        mesh = read_closed(path)
    except FabricateError as error:
        assert str(error).startswith(f"{path}: ")  # noqa: PT017
        assert "\n" not in str(error)  # noqa: PT017
    else:
        assert checked_closed(mesh) is mesh


def test_a_source_file_comes_as_it_was_read(tmp_path: Path) -> None:
    path = tmp_path / "open.obj"
    path.write_text(TETRAHEDRON.removesuffix("f 3 1 4\n"))
    assert len(source_mesh(FileConfig(path=str(path))).face_sizes) == 3


def test_limits_reach_the_reader(tmp_path: Path) -> None:
    path = tmp_path / "solid.obj"
    path.write_text(TETRAHEDRON)
    with pytest.raises(ReadError, match=r"prepare\.max_faces"):
        source_mesh(FileConfig(path=str(path)), limits=ReadLimits(max_faces=3))
