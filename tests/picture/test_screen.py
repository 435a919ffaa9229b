"""Neighbouring pixels: averages stay on their own surface, edges are where surfaces end."""

from __future__ import annotations

import numpy as np

from fabricate.picture.layout import Cell
from fabricate.picture.screen import Screen, blurred, blurred_within, dither, edges, kindred, pixel_middles
from fabricate.picture.stage import Surfels

WIDTH, HEIGHT = 23, 17


def flat_screen(owner: np.ndarray, depth: np.ndarray | None = None) -> Screen:
    """Pixels of 1 mm that look straight down on horizontal surfaces."""
    rows, columns = np.indices((HEIGHT, WIDTH))
    z = np.zeros((HEIGHT, WIDTH)) if depth is None else depth
    positions = np.stack([columns, -rows, z], axis=-1).reshape(-1, 3).astype(np.float32)
    up = np.tile(np.float32([0, 0, 1]), (HEIGHT * WIDTH, 1))
    return Screen(WIDTH, HEIGHT, Surfels(owner.ravel(), positions, up, up), 1.0)


ONE = np.zeros((HEIGHT, WIDTH), dtype=np.int64)
TWO = ONE + (np.arange(WIDTH) >= 9)
STEP = np.where(np.arange(WIDTH) >= 9, 5.0, 0.0) + ONE


def test_every_4_by_4_pixels_have_sixteen_numbers_in_a_row_and_16_by_16_have_all() -> None:
    numbers = dither(Cell(0, 0, 48, 32)).reshape(32, 48)
    blocks = numbers.reshape(8, 4, 12, 4).transpose(0, 2, 1, 3).reshape(-1, 16)
    np.testing.assert_array_equal(np.sort(blocks) - np.sort(blocks)[:, :1], np.tile(np.arange(16), (96, 1)))
    assert len(np.unique(numbers[:16, :16])) == 256
    # Any 4 x 4 window, wherever it lies, has each of the sixteen residues.
    assert len(np.unique(numbers[5:9, 7:11] % 16)) == 16


def test_pixel_middles_are_measured_from_the_origin() -> None:
    window = Cell(10, 20, 3, 2)
    middles = pixel_middles(window, origin=window.middle)
    np.testing.assert_array_equal(middles, [[-1, -0.5], [0, -0.5], [1, -0.5], [-1, 0.5], [0, 0.5], [1, 0.5]])


def test_a_constant_stays_and_a_sum_is_kept_inside() -> None:
    values = np.ones((HEIGHT * WIDTH, 2), dtype=np.float32)
    np.testing.assert_allclose(blurred(flat_screen(ONE), values), values)
    spike = np.zeros((HEIGHT, WIDTH), dtype=np.float32)
    spike[8, 11] = 16
    spread = blurred(flat_screen(ONE), spike.reshape(-1, 1)).reshape(HEIGHT, WIDTH)
    assert (spread > 0).sum() == 16
    np.testing.assert_allclose(spread[spread > 0], 1)


def test_averages_do_not_cross_to_another_owner_or_over_a_step() -> None:
    values = TWO.reshape(-1, 1).astype(np.float32)
    for screen in (flat_screen(TWO), flat_screen(ONE, STEP)):
        np.testing.assert_allclose(blurred(screen, values), values)
    assert np.abs(blurred(flat_screen(ONE), values) - values).max() > 0.1


def test_edges_are_the_two_columns_where_surfaces_meet() -> None:
    for screen in (flat_screen(TWO), flat_screen(ONE, STEP)):
        marked = edges(screen).reshape(HEIGHT, WIDTH)
        assert marked[:, 8:10].all()
        assert marked.sum() == 2 * HEIGHT
    assert not edges(flat_screen(ONE)).any()


def test_averages_within_a_mask_use_nothing_outside_it() -> None:
    mask = TWO == 0
    values = np.where(mask, 2.0, 99.0).astype(np.float32)
    mean = blurred_within(values, mask, size=4)
    np.testing.assert_allclose(mean[mask], 2, rtol=1e-5)
    np.testing.assert_allclose(mean[:, :10], 2, rtol=1e-5)
    assert not mean[:, 12:].any()


def test_kin_is_the_neighbour_on_the_same_surface() -> None:
    screen = flat_screen(TWO)
    seat = np.array([5 * WIDTH + 8, 5 * WIDTH + 9, 5 * WIDTH + 3])
    position = np.float32([[8.6, -5, 0], [8.4, -5, 0], [3, -5, 0]])
    up = np.tile(np.float32([0, 0, 1]), (3, 1))
    kin = kindred(screen, seat, Surfels(np.array([1, 0, 7]), position, up, up))
    assert screen.surfels.owner[kin[:2]].tolist() == [1, 0]
    assert (np.abs(kin[:2] % WIDTH - seat[:2] % WIDTH) <= 1).all()
    assert kin[2] == -1
