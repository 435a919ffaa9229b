"""Pictures as PNG files."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

from PIL import Image

from fabricate.output.files import write_whole


def write_png(path: Path, image: Image.Image) -> None:
    """Write the pixels and nothing else; the same picture gives the same bytes.

    Raises
    ------
    OutputError
        If the file can't be written.
    """
    buffer = BytesIO()
    pixels = image.convert("RGB")
    pixels.info = {}  # Pillow would write some of it: resolution, profile, text
    pixels.save(buffer, format="PNG")
    write_whole(path, buffer.getvalue())
