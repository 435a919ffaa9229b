"""Reading a picture: how bright it is, row by row."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image, UnidentifiedImageError

from fabricate.arrays import Floats
from fabricate.errors import ReadError


def read_luminance(path: Path) -> Floats:
    """Read how bright each pixel of a picture is, (height, width) float from 0, black, to 1, white; the top row first.

    What is transparent counts as white.

    Raises
    ------
    ReadError
        If the file is missing, no picture, damaged or too large. The message begins with the path.
    """
    try:
        if path.is_dir():
            raise ReadError(f"{path}: a picture was expected, found a folder")
        with Image.open(path) as picture:
            return _luminance(picture)
    except FileNotFoundError:
        raise ReadError(f"{path}: there is no such file; a picture was expected") from None
    except UnidentifiedImageError:
        raise ReadError(f"{path}: a picture such as PNG or JPEG was expected, found another kind of file") from None
    except Image.DecompressionBombError:
        raise ReadError(f"{path}: the picture is too large; make it smaller") from None
    except (OSError, SyntaxError, ValueError) as error:  # what Pillow raises for damaged files
        if isinstance(error, ReadError):
            raise
        raise ReadError(f"{path}: the picture cannot be read ({error})") from None


def _luminance(picture: Image.Image) -> Floats:
    if picture.mode.startswith(("I", "F")):  # more than 8 bits per pixel, which have no fixed white
        deep = np.asarray(picture, dtype=np.float64)
        return np.nan_to_num(deep / max(float(np.nanmax(deep)), 1.0), posinf=1.0)
    coloured = picture.convert("RGBA")
    paper = Image.new("RGBA", coloured.size, "white")
    return np.asarray(Image.alpha_composite(paper, coloured).convert("L"), dtype=np.float64) / 255.0
