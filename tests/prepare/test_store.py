from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fabricate.errors import PrepareError
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare import store as module
from fabricate.prepare.store import Kept, Store, checked_store

CUBE = cube(divisions=2)
MADE = Kept(replace(CUBE, creases=np.arange(len(CUBE.corners)) % 2 == 0), ("a note with \u00fcmlaut", "another"))


class Maker:
    """Makes the same again and again, and counts how often."""

    def __init__(self) -> None:
        self.calls = 0

    def __call__(self) -> Kept:
        self.calls += 1
        return MADE


@pytest.fixture(autouse=True)
def _everything_is_worth_keeping(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "WORTH_KEEPING", -1.0)


def assert_same(found: Kept) -> None:
    for name in ("points", "corners", "offsets", "creases"):
        np.testing.assert_array_equal(getattr(found.mesh, name), getattr(MADE.mesh, name))
    assert found.words == MADE.words


def test_what_was_made_is_made_once(tmp_path: Path) -> None:
    maker, store = Maker(), Store(tmp_path / "new" / "folder")
    for _ in range(3):
        assert_same(store.recalled(CUBE, "quads 7", maker))
    assert maker.calls == 1
    assert len(list((tmp_path / "new" / "folder").iterdir())) == 1


def test_without_a_folder_it_is_made_every_time() -> None:
    maker = Maker()
    for _ in range(2):
        assert_same(Store().recalled(CUBE, "quads 7", maker))
    assert maker.calls == 2


def test_quick_work_is_not_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "WORTH_KEEPING", 60.0)
    maker = Maker()
    for _ in range(2):
        Store(tmp_path).recalled(CUBE, "quads 7", maker)
    assert maker.calls == 2
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("mesh", "asked"),
    [
        (CUBE, "quads 8"),
        (CUBE.moved(CUBE.points * [1, 1, 1 + 1e-15]), "quads 7"),
        (PolygonMesh(CUBE.points, np.roll(CUBE.corners, 1), CUBE.offsets), "quads 7"),
        (replace(CUBE, creases=np.ones(len(CUBE.corners), dtype=bool)), "quads 7"),
    ],
)
def test_anything_else_is_something_else(mesh: PolygonMesh, asked: str, tmp_path: Path) -> None:
    maker, store = Maker(), Store(tmp_path)
    store.recalled(CUBE, "quads 7", maker)
    store.recalled(mesh, asked, maker)
    assert maker.calls == 2


def test_another_version_makes_it_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    maker, store = Maker(), Store(tmp_path)
    store.recalled(CUBE, "quads 7", maker)
    monkeypatch.setattr(module, "installed_version", lambda name: f"next {name}")
    store.recalled(CUBE, "quads 7", maker)
    assert maker.calls == 2


@pytest.mark.parametrize("damage", [b"", b"PK\x03\x04", b"not an archive"])
def test_a_damaged_result_is_made_again(damage: bytes, tmp_path: Path) -> None:
    maker, store = Maker(), Store(tmp_path)
    store.recalled(CUBE, "quads 7", maker)
    (path,) = tmp_path.iterdir()
    path.write_bytes(damage)
    assert_same(store.recalled(CUBE, "quads 7", maker))
    assert_same(store.recalled(CUBE, "quads 7", maker))
    assert maker.calls == 2


def test_every_truncation_is_made_again(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.recalled(CUBE, "quads 7", Maker())
    (path,) = tmp_path.iterdir()
    whole = path.read_bytes()
    for length in range(0, len(whole), 97):
        path.write_bytes(whole[:length])
        assert_same(store.recalled(CUBE, "quads 7", Maker()))


def test_a_place_that_cannot_be_written_costs_only_time(tmp_path: Path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("in the way")
    maker = Maker()
    assert_same(Store(blocked / "folder").recalled(CUBE, "quads 7", maker))
    assert maker.calls == 1
    assert blocked.read_text() == "in the way"


def test_the_oldest_go(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST_KEPT", 3)
    store = Store(tmp_path)
    for number in range(6):
        store.recalled(CUBE, f"quads {number}", Maker())
    assert len(list(tmp_path.iterdir())) == 3
    maker = Maker()
    store.recalled(CUBE, "quads 5", maker)
    assert maker.calls == 0


def test_a_named_folder_is_made_and_has_to_be_usable(tmp_path: Path) -> None:
    assert checked_store(tmp_path / "new" / "cache") == Store(tmp_path / "new" / "cache")
    assert list((tmp_path / "new" / "cache").iterdir()) == []
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(PrepareError, match="name another one"):
        checked_store(tmp_path / "file" / "cache")
