"""PNG files: pixels come back, nothing else is stored."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from fabricate.output.png import write_png

PIXELS = np.random.default_rng(3).integers(0, 256, (20, 30, 3), dtype=np.uint8)


def chunks(content: bytes) -> list[bytes]:
    """Types of the chunks of a PNG file, by its specification."""
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    position, types = 8, []
    while position < len(content):
        types.append(content[position + 4 : position + 8])
        position += 12 + int.from_bytes(content[position : position + 4], "big")
    return types


def test_pixels_come_back(tmp_path: Path) -> None:
    write_png(tmp_path / "a.png", Image.fromarray(PIXELS))
    with Image.open(tmp_path / "a.png") as image:
        np.testing.assert_array_equal(np.asarray(image), PIXELS)


def test_only_pixels_are_stored_and_the_second_file_is_the_same(tmp_path: Path) -> None:
    image = Image.fromarray(PIXELS)
    image.info = {"dpi": (300, 300), "comment": "made today"}
    write_png(tmp_path / "a.png", image)
    write_png(tmp_path / "b.png", Image.fromarray(PIXELS))
    content = (tmp_path / "a.png").read_bytes()
    assert set(chunks(content)) == {b"IHDR", b"IDAT", b"IEND"}
    assert content == (tmp_path / "b.png").read_bytes()
    assert image.info == {"dpi": (300, 300), "comment": "made today"}
