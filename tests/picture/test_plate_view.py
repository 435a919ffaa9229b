"""Pictures of plates: all of it in view, from above, and flat faces of one shade."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.mesh.cube import cube
from fabricate.picture.plate_view import MARGIN, plate_image
from fabricate.solid.part import Part

SLAB = cube(divisions=1)


def slab(name: str, *, left: float, width: float) -> Part:
    """Return a slab 20 mm deep and 2 mm high."""
    corners = SLAB.corners.reshape(-1, 4)
    triangles = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    unit = (SLAB.points - SLAB.points.min(axis=0)) / np.ptp(SLAB.points, axis=0)
    return Part(name, unit * [width, 20.0, 2.0] + [left, 0.0, 0.0], triangles)


def coloured(parts: list[Part]) -> np.ndarray:
    """Return where a picture of blue parts is blue."""
    pixels = np.asarray(plate_image(parts, width=400)).astype(int)
    return pixels[:, :, 2] > pixels[:, :, 0] + 40


def test_the_plate_fills_the_picture_but_for_the_margin() -> None:
    blue = coloured([slab("plate", left=0, width=60)])
    columns = np.flatnonzero(blue.any(axis=0))
    rows = np.flatnonzero(blue.any(axis=1))
    assert columns[0] == pytest.approx(MARGIN * 400, abs=3)
    assert columns[-1] == pytest.approx((1 - MARGIN) * 400, abs=3)
    assert rows[0] == pytest.approx(blue.shape[0] - rows[-1], abs=4)


def test_it_is_seen_from_above() -> None:
    blue = coloured([slab("plate", left=0, width=60)])
    rows, columns = (np.ptp(np.flatnonzero(blue.any(axis=axis))) for axis in (1, 0))
    assert 0.75 < (rows / columns) / (20 / 60) < 1.0


def test_a_flat_face_has_one_shade_beside_a_small_one() -> None:
    pixels = np.asarray(plate_image([slab("plate", left=0, width=60)], width=400)).astype(int)
    middle = pixels[pixels.shape[0] // 2 - 20 : pixels.shape[0] // 2 + 20, 150:250]
    assert np.ptp(middle, axis=(0, 1)).max() < 25


def test_without_parts_there_is_no_picture() -> None:
    with pytest.raises(ValueError, match="at least one part"):
        plate_image([])
