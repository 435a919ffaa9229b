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


def silent(_: str) -> None:
    pass


def config(source: str, *, folder: Path = Path(), more: str = "") -> Config:
    text = f'[source]\n{source}\nsize = "60 mm"\n[pattern]\ntile_size = "14 mm"\n[solid]\ntolerance = "0.4 mm"\n'
    text += more
    return Config.model_validate(tomllib.loads(text), context=ConfigFolder(folder))


def test_stages_are_told_in_the_order_of_the_line() -> None:
    told: list[str] = []
    asked = config('shape = "cube"')
    (body,) = read_bodies(asked, name="cube", progress=told.append, store=NOTHING_KEPT)
    divided(body, asked, store=NOTHING_KEPT)
    assert (body.name, body.field) == ("cube", None)
    assert [stage for stage in told if stage in {"read", "prepare", "quads", "duotone", "cut"}] == [
        *("read", "prepare", "quads", "duotone", "cut")
    ]


def test_the_surface_is_of_the_size_asked_for_and_has_one_curve() -> None:
    asked = config('shape = "torus"')
    (body,) = read_bodies(asked, name="ring", progress=silent, store=NOTHING_KEPT)
    found = divided(body, asked, store=NOTHING_KEPT)
    surface = found.fitting.surface
    assert np.ptp(surface.points, axis=0).max() == pytest.approx(60.0, rel=2e-3)
    assert len(surface.curves) == 1
    assert found.fitting.tolerance == 0.4


def test_what_is_wrong_with_a_file_names_it(tmp_path: Path) -> None:
    (tmp_path / "open.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    with pytest.raises(FabricateError, match=r"open\.off"):
        read_bodies(config('path = "open.off"', folder=tmp_path), name="open", progress=silent, store=NOTHING_KEPT)


def test_bodies_of_one_file_are_numbered_and_timed_apart(tmp_path: Path) -> None:
    """The second does not count the time that the first took to divide."""
    box = "OFF\n{0} {1} 0\n{2}\n{3}\n"
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    points = [f"{x + 3 * k} {y} {z}" for k in (0, 1) for x, y, z in corners]
    rows = [f"4 {' '.join(str(8 * k + corner) for corner in face)}" for k in (0, 1) for face in faces]
    (tmp_path / "two.off").write_text(box.format(16, 12, "\n".join(points), "\n".join(rows)))
    asked = config('path = "two.off"', folder=tmp_path, more='[prepare]\ncomponents = "each"\n')
    first, second = read_bodies(asked, name="two", progress=silent, store=NOTHING_KEPT)
    assert [first.name, second.name] == ["two-1", "two-2"]
    divided(first, asked, store=NOTHING_KEPT)
    second.watch.begin("quads")
    assert second.watch.ended()["prepare"] == first.watch.ended()["prepare"]
