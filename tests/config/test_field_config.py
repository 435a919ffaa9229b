"""The section [field]: of one kind, and only where something follows it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from fabricate.config import Config, DirectionConfig, HeightConfig, ImageConfig
from fabricate.config.field_config import FIELDS
from fabricate.errors import ConfigError

Read = Callable[..., Config]
FOLLOWED = '[source]\npath = "some.ply"\n[pattern]\ntree = "field"\n[field]\n'
NEEDED = {"image": 'image = "some.png"\n', "attribute": 'attribute = "heat"\n'}


@pytest.mark.parametrize("kind", FIELDS)
def test_every_kind_can_be_asked_for(read: Read, kind: str) -> None:
    found = read(FOLLOWED + f'kind = "{kind}"\n' + NEEDED.get(kind, "")).field
    assert isinstance(found, FIELDS[kind])
    assert found.jitter == 0.0


def test_keys_become_values(read: Read) -> None:
    height = read(FOLLOWED + 'kind = "height"\naxis = [1, 0, 0]\nreverse = true\njitter = 0.1').field
    assert height == HeightConfig(kind="height", axis=(1.0, 0.0, 0.0), reverse=True, jitter=0.1)
    direction = read(FOLLOWED + 'kind = "direction"\nlines = "circles"\npoint = ["1 cm", "0 mm", "0 mm"]').field
    assert direction == DirectionConfig(kind="direction", lines="circles", point=(10.0, 0.0, 0.0))


def test_a_picture_is_found_from_the_folder_of_the_config(read: Read, tmp_path: Path) -> None:
    field = read(FOLLOWED + 'kind = "image"\nimage = "some.png"').field
    assert isinstance(field, ImageConfig)
    assert field.file == tmp_path / "some.png"


def complaint(read: Read, text: str, *overrides: str) -> str:
    with pytest.raises(ConfigError) as caught:
        read(text, *overrides)
    return str(caught.value)


def test_a_field_and_a_tree_that_follows_it_need_each_other(read: Read) -> None:
    without = FOLLOWED.replace("[field]\n", "")
    assert "pattern.tree: expected a section [field]" in complaint(read, without)
    followed = FOLLOWED + 'kind = "height"\n'
    assert "field: nothing follows this field" in complaint(read, followed, "pattern.tree=random")


def test_attributes_need_a_file(read: Read) -> None:
    text = (FOLLOWED + 'kind = "attribute"\nattribute = "heat"').replace('path = "some.ply"', 'shape = "cube"')
    assert 'field.kind: kind = "attribute" reads values of a PLY file' in complaint(read, text)


def test_a_setting_makes_a_field(read: Read) -> None:
    found = read('[source]\nshape = "cube"\n', "pattern.tree=field", "field.kind=height", "field.axis=[0, 1, 0]")
    assert found.field == HeightConfig(kind="height", axis=(0.0, 1.0, 0.0))
