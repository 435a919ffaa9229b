"""Overrides set one key, replace its alternative, and are blamed as what they are."""

from collections.abc import Callable

import pytest

from fabricate.config import Config, CubeConfig, FileConfig, PatternConfig, ShopConfig
from fabricate.config.overrides import Setting, parse_setting, with_setting
from fabricate.config.solid_config import BaseConfig, OpeningsConfig
from fabricate.errors import ConfigError

TORUS = '[source]\nshape = "torus"\n'
Read = Callable[..., Config]


def complaint(read: Read, text: str, *overrides: str) -> str:
    with pytest.raises(ConfigError) as caught:
        read(text, *overrides)
    message = str(caught.value)
    assert "\n" not in message
    return message


@pytest.mark.parametrize(
    ("override", "section", "key", "value"),
    [
        ("solid.thickness=2mm", "solid", "thickness", 2.0),
        ("solid.thickness = 2 mm", "solid", "thickness", 2.0),
        ('solid.thickness="0.2 cm"', "solid", "thickness", 2.0),
        ("pattern.seed=11", "pattern", "seed", 11),
        ("pattern.arc=0.4", "pattern", "arc", 0.4),
        ("pattern.tree=depth-first", "pattern", "tree", "depth-first"),
        ("process.name=sla", "process", "name", "sla"),
        ("source.around=20", "source", "around", 20),
    ],
)
def test_an_override_sets_its_key(read: Read, override: str, section: str, key: str, value: object) -> None:
    assert getattr(getattr(read(TORUS, override), section), key) == value


def test_an_override_sets_one_key_of_a_table(read: Read) -> None:
    assert read(TORUS, "process.shop.polygons=30000").process.shop == ShopConfig(polygons=30_000)
    assert read(TORUS, "solid.base.height=4mm").solid.base == BaseConfig(height=4.0)
    assert read(TORUS, "solid.openings.diameter=3mm", "solid.openings.count=2").solid.openings == OpeningsConfig(
        diameter=3.0, count=2
    )
    both = TORUS + '[process]\nshop = { wall = "1 mm", polygons = 5000 }'
    assert read(both, "process.shop.polygons=30000").process.shop == ShopConfig(wall=1.0, polygons=30_000)
    varying = TORUS + '[solid]\nthickness = { min = "2 mm", max = "3 mm", by = "height" }'
    assert read(varying, "solid.thickness.max=4mm").solid.thickness_range == (2.0, 4.0)


def test_what_a_table_lacks_is_named(read: Read) -> None:
    assert "solid.openings.diameter: expected a length" in complaint(read, TORUS, "solid.openings.count=2")


def test_an_override_replaces_its_alternative(read: Read) -> None:
    fine = TORUS + '[pattern]\ntile_size = "3 mm"'
    assert read(fine, "pattern.levels=1").pattern == PatternConfig(levels=1)
    assert read(fine, "pattern.levels=1", "pattern.tile_size=9mm").pattern.tile_size == 9.0
    assert read(TORUS, "pattern.rings=[0.4, 0.6]").pattern.positions == (0.4, 0.6)
    bent = TORUS + "[pattern]\narc = 0.4"
    assert read(bent, "pattern.rings=three").pattern.arc is None
    assert read(bent, "pattern.rings=three", "pattern.arc=0.6").pattern.positions == (0.6,)
    assert read(bent, "pattern.area_share=0.4").pattern == PatternConfig(area_share=0.4)
    assert read(TORUS, "pattern.area_share=0.6", "pattern.rings=three").pattern == PatternConfig(rings="three")
    assert read(TORUS + "[pattern]\narea_share = 0.6", "pattern.arc=0.4").pattern == PatternConfig(arc=0.4)
    assert isinstance(read('[source]\npath = "a.obj"', "source.shape=cube").source, CubeConfig)
    assert isinstance(read(TORUS, "source.path=a.obj").source, FileConfig)


def test_the_last_override_of_a_key_wins(read: Read) -> None:
    assert read(TORUS, "pattern.seed=1", "pattern.seed=2").pattern.seed == 2


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("", ("expected key=value",)),
        ("solid.thickness", ("expected key=value", '"solid.thickness"')),
        ("pattern=3", ("pattern:", "unknown key", "pattern.seed")),
        ("pattern.sed=3", ("pattern.sed", "did you mean pattern.seed?")),
        ("patern.seed=3", ("patern.seed", "did you mean pattern.seed?")),
        ("thickness=3mm", ("thickness", "did you mean solid.thickness?")),
        ("solid.thickness.mm=3", ("solid.thickness.mm", "known here: solid.thickness.min, solid.thickness.max")),
        ("solid.clearance.mm=3", ("solid.clearance.mm", "did you mean solid.clearance?")),
        ("process.shop.polygon=5000", ("process.shop.polygon", "did you mean process.shop.polygons?")),
        ("process.shop.polygons=10", ("process.shop.polygons", "at least 1000")),
        ("process.shop.polygons.most=5000", ("unknown key",)),
        ("solid.thickness=2", ("solid.thickness", "unit", '"2 mm"')),
        ("solid.core=bleu", ("solid.core", 'did you mean "blue"?')),
        ("pattern.seed=1\nlevels=2", ("pattern.seed", "whole number")),
        ('curve.views=["above"]', ("curve.views[0]", '"front"', '"above"')),
        ("pattern.seed=", ("pattern.seed", "whole number", '""')),
        ("pattern.seed=" + "[" * 5000, ("pattern.seed", "whole number", "...")),
    ],
)
def test_a_wrong_override_is_blamed_on_the_option(read: Read, override: str, words: tuple[str, ...]) -> None:
    message = complaint(read, TORUS, override)
    assert message.startswith("--set: ")
    assert not [word for word in words if word not in message], message


def test_an_override_cannot_hide_a_section_that_is_none(read: Read) -> None:
    assert "expected a section [pattern]" in complaint(read, "pattern = 1\n" + TORUS, "pattern.seed=3")


def test_the_document_itself_is_not_edited() -> None:
    document = {"pattern": {"tile_size": "3 mm"}}
    assert with_setting(document, parse_setting("pattern.levels=1")) == {"pattern": {"levels": 1}}
    assert with_setting({}, Setting("pattern.seed", 4)) == {"pattern": {"seed": 4}}
    assert document == {"pattern": {"tile_size": "3 mm"}}
