from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest

from fabricate.config import Config
from fabricate.config.section import ConfigFolder
from fabricate.dividing import divided, read_bodies
from fabricate.errors import FabricateError
from fabricate.prepare.store import NOTHING_KEPT
from fabricate.stopwatch import Stopwatch


def config(source: str, *, folder: Path = Path()) -> Config:
    text = f'[source]\n{source}\nsize = "60 mm"\n[pattern]\ntile_size = "14 mm"\n[solid]\ntolerance = "0.4 mm"\n'
    return Config.model_validate(tomllib.loads(text), context=ConfigFolder(folder))


def test_stages_are_told_in_the_order_of_the_line() -> None:
    told: list[str] = []
    watch, asked = Stopwatch(told.append), config('shape = "cube"')
    (body,), field = read_bodies(asked, watch=watch, store=NOTHING_KEPT)
    divided(body, asked, field, watch=watch, store=NOTHING_KEPT)
    assert field is None
    assert [stage for stage in told if stage in {"read", "prepare", "quads", "duotone", "cut"}] == [
        *("read", "prepare", "quads", "duotone", "cut")
    ]


def test_the_surface_is_of_the_size_asked_for_and_has_one_curve() -> None:
    watch, asked = Stopwatch(lambda _: None), config('shape = "torus"')
    (body,), field = read_bodies(asked, watch=watch, store=NOTHING_KEPT)
    found = divided(body, asked, field, watch=watch, store=NOTHING_KEPT)
    surface = found.fitting.surface
    assert np.ptp(surface.points, axis=0).max() == pytest.approx(60.0, rel=2e-3)
    assert len(surface.curves) == 1
    assert found.fitting.tolerance == 0.4


def test_what_is_wrong_with_a_file_names_it(tmp_path: Path) -> None:
    (tmp_path / "open.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    with pytest.raises(FabricateError, match=r"open\.off"):
        read_bodies(config('path = "open.off"', folder=tmp_path), watch=Stopwatch(lambda _: None), store=NOTHING_KEPT)
