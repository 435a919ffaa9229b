"""The preview: both colours on both sides, nothing hidden, input untouched."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from fabricate.picture.preview import preview_image
from fabricate.solid.part import Part

BALL = trimesh.creation.icosphere(subdivisions=3, radius=20)
RING = trimesh.creation.torus(30, 6)
PARTS = (Part("yellow", BALL.vertices, BALL.faces), Part("blue", RING.vertices, RING.faces))


def picture(parts: tuple[Part, ...]) -> np.ndarray:
    return np.asarray(preview_image(parts, width=480, height=240)).astype(int)


def yellowish(pixels: np.ndarray) -> np.ndarray:
    return pixels[:, :, 0] - pixels[:, :, 2] > 40


def bluish(pixels: np.ndarray) -> np.ndarray:
    return pixels[:, :, 2] - pixels[:, :, 0] > 25


def test_both_colours_are_on_the_left_and_on_the_right() -> None:
    pixels = picture(PARTS)
    for half in (pixels[:, :240], pixels[:, 240:]):
        assert yellowish(half).sum() > 300
        assert bluish(half).sum() > 300


def test_pulled_apart_more_is_seen_of_each_part_than_in_its_seat() -> None:
    pixels = picture(PARTS)
    for colour in (yellowish, bluish):
        seated = colour(pixels[:, :160]).sum()
        assert colour(pixels[:, 160:]).sum() > 1.1 * seated


def test_a_part_looks_as_large_alone_as_seated() -> None:
    pixels = picture((PARTS[1],))
    left, right = bluish(pixels[:, :240]).sum(), bluish(pixels[:, 240:]).sum()
    assert left == pytest.approx(right, rel=0.01)


def test_wide_parts_lie_one_above_the_other() -> None:
    wide = tuple(Part(part.name, part.points * [2, 2, 0.3], part.triangles) for part in PARTS)
    pixels = picture(wide)[:, 240:]
    rows = [np.flatnonzero(colour(pixels).any(axis=1)) for colour in (yellowish, bluish)]
    assert rows[0].max() < rows[1].min()


def test_the_preview_is_as_large_as_asked_and_the_same_every_time() -> None:
    image = preview_image(PARTS, width=300, height=200)
    assert image.width == 300
    assert image.height <= 200
    assert image.tobytes() == preview_image(PARTS, width=300, height=200).tobytes()


def test_parts_are_left_as_they_are() -> None:
    before = [(part.points.copy(), part.triangles.copy()) for part in PARTS]
    picture(PARTS)
    for part, (points, triangles) in zip(PARTS, before, strict=True):
        np.testing.assert_array_equal(part.points, points)
        np.testing.assert_array_equal(part.triangles, triangles)


@pytest.mark.parametrize("parts", [(), (PARTS[0], Part("empty", PARTS[1].points, np.zeros((0, 3))))])
def test_nothing_to_show_is_an_error(parts: tuple[Part, ...]) -> None:
    with pytest.raises(ValueError, match="expected parts with triangles"):
        preview_image(parts)
