"""Pictures are read as luminance; what is no picture is refused in one line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from fabricate.errors import ReadError
from fabricate.formats.read_image import read_luminance


def saved(path: Path, picture: Image.Image) -> Path:
    picture.save(path)
    return path


def test_rows_and_columns_are_those_of_the_picture(tmp_path: Path) -> None:
    grey = np.array([[0, 51, 102], [153, 204, 255]], dtype=np.uint8)
    found = read_luminance(saved(tmp_path / "grey.png", Image.fromarray(grey)))
    assert found == pytest.approx(grey / 255.0, abs=1e-9)


@pytest.mark.parametrize(
    ("colour", "luminance"), [("white", 1.0), ("black", 0.0), ("red", 0.299), ("lime", 0.587), ("blue", 0.114)]
)
def test_colours_have_the_luminance_of_television(tmp_path: Path, colour: str, luminance: float) -> None:
    found = read_luminance(saved(tmp_path / "colour.png", Image.new("RGB", (2, 3), colour)))
    assert found.shape == (3, 2)
    assert found == pytest.approx(luminance, abs=1 / 255)


def test_what_is_transparent_is_white(tmp_path: Path) -> None:
    picture = Image.new("RGBA", (2, 1), (0, 0, 0, 255))
    picture.putpixel((1, 0), (0, 0, 0, 0))
    assert read_luminance(saved(tmp_path / "clear.png", picture)).tolist() == [[0.0, 1.0]]


@pytest.mark.parametrize("mode", ["P", "1", "LA", "CMYK"])
def test_other_kinds_of_pixels_can_be_read(tmp_path: Path, mode: str) -> None:
    path = tmp_path / ("some.tif" if mode == "CMYK" else "some.png")
    found = read_luminance(saved(path, Image.new("RGB", (2, 2), "white").convert(mode)))
    assert found == pytest.approx(1.0)


def test_sixteen_bits_keep_their_order(tmp_path: Path) -> None:
    deep = np.array([[0, 1, 700], [701, 40_000, 65_535]], dtype=np.uint16)
    found = read_luminance(saved(tmp_path / "deep.png", Image.fromarray(deep)))
    assert (np.diff(found.ravel()) > 0.0).all()
    assert (found.min(), found.max()) == (0.0, 1.0)


def refusal(path: Path) -> str:
    with pytest.raises(ReadError) as caught:
        read_luminance(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: ")
    assert "\n" not in message
    return message


def test_what_is_no_picture_is_refused(tmp_path: Path) -> None:
    assert "no such file" in refusal(tmp_path / "none.png")
    assert "found a folder" in refusal(tmp_path)
    text = tmp_path / "text.png"
    text.write_text("not a picture")
    assert "found another kind of file" in refusal(text)


def test_damaged_pictures_are_refused(tmp_path: Path) -> None:
    noise = np.random.default_rng(0).integers(0, 256, (64, 64), dtype=np.uint8)
    whole = saved(tmp_path / "whole.png", Image.fromarray(noise)).read_bytes()
    cut = tmp_path / "cut.png"
    for kept in (60, 700, len(whole) // 2):
        cut.write_bytes(whole[:kept])
        assert "picture" in refusal(cut)


def test_pictures_that_unpack_to_too_much_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = saved(tmp_path / "large.png", Image.new("L", (100, 100)))
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", 1000)
    assert "too large" in refusal(path)
