"""Contact sheets: every picture in its place, in order, and a caption for what has none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from fabricate.picture.contact_sheet import CAPTION, COLUMN, MOST_COLUMNS, Entry, contact_sheet

COLOURS = [(200, 30, 30), (30, 200, 30), (30, 30, 200), (200, 200, 30), (30, 200, 200)]


def entries(folder: Path, count: int) -> list[Entry]:
    made = []
    for number in range(count):
        path = folder / f"{number}.png"
        Image.new("RGB", (1200, 400 + 100 * (number % 3)), COLOURS[number % 5]).save(path)
        made.append(Entry(f"name-{number}", path))
    return made


def boxes(sheet: Image.Image) -> list[tuple[int, int, int, int]]:
    """Left, top, width and height of each block of colour, in the order of the colours."""
    pixels = np.asarray(sheet)
    found = []
    for colour in COLOURS:
        rows, columns = np.nonzero((pixels == colour).all(axis=2))
        if len(rows):
            found.append((columns.min(), rows.min(), np.ptp(columns) + 1, np.ptp(rows) + 1))
    return found


def test_pictures_are_in_order_and_of_one_width(tmp_path: Path) -> None:
    sheet = contact_sheet(entries(tmp_path, 5))
    found = boxes(sheet)
    assert [width for _, _, width, _ in found] == [COLUMN] * 5
    assert [height for *_, height in found] == [200, 250, 300, 200, 250]
    places = [(top + height, left) for left, top, _, height in found]
    assert places == sorted(places)
    assert len({bottom for bottom, _ in places}) == 3
    assert sheet.width == 2 * COLUMN


@pytest.mark.parametrize("count", [1, 2, 3, 10, 50])
def test_every_number_of_pictures_has_a_sheet(tmp_path: Path, count: int) -> None:
    sheet = contact_sheet(entries(tmp_path, count))
    columns = sheet.width // COLUMN
    assert min(count, 2) <= columns <= MOST_COLUMNS
    rows = -(-count // columns)
    assert rows * (200 + CAPTION) <= sheet.height <= rows * (300 + CAPTION)


def test_what_was_not_made_has_a_caption_and_no_picture(tmp_path: Path) -> None:
    made = entries(tmp_path, 3)
    whole = np.asarray(contact_sheet(made)).astype(int)
    without = np.asarray(contact_sheet([made[0], Entry("lost", None, "not made"), made[2]])).astype(int)
    assert [colour for colour in COLOURS if (without == colour).all(axis=2).any()] == [COLOURS[0], COLOURS[2]]
    below = without[200:][: CAPTION + 50, COLUMN:]
    reddish = below[:, :, 0] - below[:, :, 2] > 60
    assert reddish.sum() > 50
    assert not ((whole[:, :, 0] - whole[:, :, 2] > 60) & (whole != COLOURS[0]).any(axis=2)).any()


def test_long_names_stay_in_their_column(tmp_path: Path) -> None:
    made = entries(tmp_path, 2)
    short = np.asarray(contact_sheet([Entry("a", made[0].picture), made[1]]))
    long = np.asarray(contact_sheet([Entry("long name " * 30, made[0].picture), made[1]]))
    assert np.array_equal(short[:, COLUMN:], long[:, COLUMN:])
    assert not np.array_equal(short[:, :COLUMN], long[:, :COLUMN])


def test_the_same_entries_give_the_same_sheet(tmp_path: Path) -> None:
    made = entries(tmp_path, 3)
    assert contact_sheet(made).tobytes() == contact_sheet(made).tobytes()


def test_an_empty_sheet_is_refused() -> None:
    with pytest.raises(ValueError, match="at least one"):
        contact_sheet([])
