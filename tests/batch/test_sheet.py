"""The sheet of a batch: from the folders that were made, and nothing where none was."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from fabricate.batch.sheet import write_sheet
from fabricate.batch.workers import Outcome
from fabricate.errors import OutputError


def made(out: Path, *names: str) -> None:
    for name in names:
        (out / name).mkdir()
        Image.new("RGB", (1200, 400), (200, 30, 30)).save(out / name / "preview.png")


def red(path: Path) -> int:
    """Count the pictures by their area."""
    with Image.open(path) as sheet:
        return int((np.asarray(sheet) == (200, 30, 30)).all(axis=2).sum()) // (600 * 200)


def test_every_folder_is_on_the_sheet(tmp_path: Path) -> None:
    made(tmp_path, "a", "b-1", "b-2", "other")
    outcomes = [
        Outcome("a", 0, "ok", (("a", True),)),
        Outcome("lost", 2, "wrong"),
        Outcome("b", 1, "a gap", (("b-1", True), ("b-2", False))),
    ]
    path = write_sheet(outcomes, tmp_path)
    assert path == tmp_path / "contact-sheet.png"
    assert red(path) == 3


def test_nothing_is_written_where_nothing_was_made(tmp_path: Path) -> None:
    made(tmp_path, "a")
    assert write_sheet([Outcome("a", 2, "wrong"), Outcome("b", 2, "wrong")], tmp_path) is None
    assert [path.name for path in tmp_path.iterdir()] == ["a"]


def test_a_sheet_from_before_is_replaced_whole(tmp_path: Path) -> None:
    made(tmp_path, "a")
    (tmp_path / "contact-sheet.png").write_text("old")
    path = write_sheet([Outcome("a", 0, "ok", (("a", True),)), Outcome("b", 2, "wrong")], tmp_path)
    assert path is not None
    assert red(path) == 1
    assert {each.name for each in tmp_path.iterdir()} == {"a", "contact-sheet.png"}


def test_a_folder_in_the_way_is_said_in_one_line(tmp_path: Path) -> None:
    made(tmp_path, "a", "contact-sheet.png")
    with pytest.raises(OutputError, match=r"contact-sheet\.png"):
        write_sheet([Outcome("a", 0, "ok", (("a", True),))], tmp_path)
