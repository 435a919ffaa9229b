"""Drawings as SVG: one unit is one millimetre, strokes come back, and names cannot break the file."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from fabricate.errors import OutputError
from fabricate.output.curve_svg import MARGIN, write_curve_svg
from fabricate.picture.line_drawing import LineDrawing

LINE = np.array([[1.0, 2.0], [3.25, 4.0], [10.0, 1.23456]])
LOOP = np.array([[5.0, 5.0], [6.0, 5.0], [6.0, 6.0], [5.0, 5.0]])
DRAWING = LineDrawing("front", 40.0, 25.5, (LINE, LOOP), (LINE[::-1],))
SVG = "{http://www.w3.org/2000/svg}"


def read(path: Path) -> tuple[ElementTree.Element, dict[str, str]]:
    root = ElementTree.parse(path).getroot()  # noqa: S314 - written by ourselves
    return root, {str(each.get("id")): str(each.get("d")) for each in root.iter(f"{SVG}path")}


def strokes(commands: str) -> list[np.ndarray]:
    found = re.findall(r"M([^MZ]+)Z?", commands)
    return [np.array([list(map(float, pair.split(","))) for pair in each.split(" L")]) for each in found]


def test_the_page_is_the_body_and_a_margin_in_true_size(tmp_path: Path) -> None:
    write_curve_svg(tmp_path / "a.svg", DRAWING, title="a")
    root, _ = read(tmp_path / "a.svg")
    assert (root.get("width"), root.get("height")) == (f"{40 + 2 * MARGIN:g}mm", f"{25.5 + 2 * MARGIN:g}mm")
    assert root.get("viewBox") == f"0 0 {40 + 2 * MARGIN:g} {25.5 + 2 * MARGIN:g}"


def test_strokes_come_back(tmp_path: Path) -> None:
    write_curve_svg(tmp_path / "a.svg", DRAWING, title="a")
    _, paths = read(tmp_path / "a.svg")
    assert list(paths) == ["visible"]
    line, loop = strokes(paths["visible"])
    assert line == pytest.approx(LINE + MARGIN, abs=6e-4)
    assert loop == pytest.approx(LOOP[:-1] + MARGIN)
    assert paths["visible"].endswith("Z")
    assert paths["visible"].count("Z") == 1


def test_hidden_strokes_lie_under_the_visible_ones(tmp_path: Path) -> None:
    write_curve_svg(tmp_path / "a.svg", DRAWING, title="a", with_hidden=True)
    _, paths = read(tmp_path / "a.svg")
    assert list(paths) == ["hidden", "visible"]
    assert strokes(paths["hidden"])[0] == pytest.approx(LINE[::-1] + MARGIN, abs=6e-4)


def test_any_name_makes_a_title(tmp_path: Path) -> None:
    write_curve_svg(tmp_path / "a.svg", DRAWING, title='<b> & "c" ü')
    root, _ = read(tmp_path / "a.svg")
    assert root.findtext(f"{SVG}title") == '<b> & "c" ü, front'


def test_a_place_that_cannot_be_written_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(OutputError):
        write_curve_svg(tmp_path / "none" / "a.svg", DRAWING, title="a")
