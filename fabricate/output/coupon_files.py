"""The files of a fit coupon but its report."""

from __future__ import annotations

from pathlib import Path

from fabricate.output.png import write_png
from fabricate.output.stl import write_stl
from fabricate.output.three_mf import write_3mf
from fabricate.picture.plate_view import plate_image
from fabricate.solid.coupon import Coupon
from fabricate.solid.part import joined

FILE = "coupon.stl"
"""The whole coupon, as it lies on the build plate."""


def write_coupon(folder: Path, coupon: Coupon, *, name: str) -> Path:
    """Write coupon.stl, coupon.3mf, in which the plate and what is loose in it have two colours, and preview.png.

    Returns the path of the STL file. `name` is the coupon's, as programs show it.

    Raises
    ------
    OutputError
        If a file cannot be written.
    """
    parts = coupon.plate, coupon.inserts
    write_stl(folder / FILE, joined("coupon", parts))
    write_3mf(folder / "coupon.3mf", parts, name=name)
    write_png(folder / "preview.png", plate_image(parts))
    return folder / FILE
